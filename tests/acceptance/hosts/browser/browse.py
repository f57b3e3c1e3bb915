#!/usr/bin/env python3
"""Acts as a person with a browser at the live page: looks at every panel, clicks, and checks the result (for live.py)."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

import firefox

PANELS = ['Axes', 'Signals', 'Plot', 'Timeline', 'Registers', 'Bus', 'Program', 'Events', 'Faults']
PATIENCE_S = 20
# The texts and hints that their boxes cut off.
CUT = """
const isSeen = (it) => it.getBoundingClientRect().width > 0 && !it.closest('details:not([open])');
const isCut = (it) => getComputedStyle(it).overflowX !== 'visible' && it.scrollWidth > it.clientWidth + 1 && it.clientWidth > 0;
const pen = document.createElement('canvas').getContext('2d');
const isShort = (it) => {
  const style = getComputedStyle(it);
  pen.font = `${style.fontSize} ${style.fontFamily}`;
  return !it.value && pen.measureText(it.placeholder).width > it.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) + 1;
};
return [...document.querySelectorAll('#panel small, #panel button, #panel code, #panel b')].filter((it) => isSeen(it) && isCut(it)).map((it) => it.textContent)
  .concat([...document.querySelectorAll('#panel input[placeholder]')].filter((it) => isSeen(it) && isShort(it)).map((it) => it.placeholder))"""


def browser(width, height, dark, folder):
    options = webdriver.ChromeOptions()
    for flag in ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--hide-scrollbars',
                 f'--user-data-dir={folder}', f'--window-size={width},{height}', '--force-device-scale-factor=1']:
        options.add_argument(flag)
    options.add_experimental_option('prefs', {'download.default_directory': folder})  # and not in the user's own
    if dark:
        options.add_argument('--force-dark-mode')
    options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
    it = webdriver.Chrome(service=Service('/usr/bin/chromedriver'), options=options)
    scheme = 'dark' if dark else 'light'
    it.execute_cdp_cmd('Emulation.setEmulatedMedia', {'features': [{'name': 'prefers-color-scheme', 'value': scheme}]})
    it.execute_cdp_cmd('Emulation.setDeviceMetricsOverride',
                       {'width': width, 'height': height, 'deviceScaleFactor': 1, 'mobile': False})
    return it


class Visit:
    def __init__(self, arguments, width, height, dark, in_firefox=False):
        self.arguments = arguments
        self.folder = tempfile.TemporaryDirectory()
        self.driver = firefox.Firefox(width, height, dark) if in_firefox else browser(width, height, dark, self.folder.name)
        self.name = f"{'narrow' if width < 700 else 'wide'}_{'dark' if dark else 'light'}"
        self.driver.get(arguments.address)
        self.until('the bench is there', lambda: self.texts('.axis h3') or self.find('.travel'))

    def close(self):
        errors = [line['message'] for line in self.driver.get_log('browser') if line['level'] == 'SEVERE']
        self.driver.quit()
        for _ in range(20):  # its last processes may still write for a moment
            try:
                shutil.rmtree(self.folder.name)
                break
            except OSError:
                time.sleep(0.1)
        self.folder.cleanup()
        # While the server or the daemon is away, the browser reports connection errors, as it should.
        errors = [error for error in errors if 'WebSocket connection' not in error]
        if errors:
            fail(f'the browser complains: {errors}')

    def find(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        return [element.text for element in self.find(selector)]

    def until(self, what, condition):
        end = time.monotonic() + PATIENCE_S
        problem = ''
        while time.monotonic() < end:
            try:
                if condition():
                    print(f'{self.name}: {what}', flush=True)
                    return
            except Exception as error:  # elements come and go while the page is drawn
                problem = f' ({error.__class__.__name__})'
            time.sleep(0.1)
        self.picture('failed')
        fail(f'{self.name}: not so: {what}{problem}')

    def show(self, panel):
        self.driver.find_element(By.ID, f'tab_{panel}').click()
        self.until(f'{panel} is shown', lambda: self.driver.find_element(By.ID, f'tab_{panel}').get_attribute('aria-selected') == 'true')

    def press(self, title):
        self.driver.find_element(By.CSS_SELECTOR, f'button[title="{title}"]').click()

    def picture(self, name):
        if self.arguments.pictures:
            folder = pathlib.Path(self.arguments.pictures)
            folder.mkdir(parents=True, exist_ok=True)
            self.driver.save_screenshot(str(folder / f'{self.arguments.prefix}{self.name}_{name}.png'))


def fail(text):
    print(text, file=sys.stderr)
    sys.exit(1)


def control(arguments, *words):
    command = [arguments.understudy, 'ctl', '--control', arguments.control, '--json', *words]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    return json.loads(answer.stdout) if answer.stdout.strip() else {'ok': False, 'error': answer.stderr}


def time_ns(arguments):
    return control(arguments, 'status')['status']['simulated_time_ns']


def look_at_panels(visit):
    for panel in PANELS:
        visit.show(panel)
        if panel == 'Signals':
            visit.until('signals are listed', lambda: visit.find('.signal'))
        if panel == 'Plot':
            visit.until('a curve is drawn', lambda: visit.find('.drawing canvas'))
        if panel == 'Registers' and visit.find('.registers'):
            visit.until('registers have values', lambda: any(text.strip(' –') for text in visit.texts('.registers .value')))
        time.sleep(0.5)
        visit.picture(panel.lower())
        if cut := visit.driver.execute_script(CUT):
            fail(f'{visit.name}: {panel} cuts off: {cut}')
        width = visit.driver.execute_script('return document.documentElement.scrollWidth - innerWidth')
        if width > 0:
            fail(f'{visit.name}: {panel} is {width} dots wider than the window')


def time_stands_and_goes(visit):
    visit.press('stop time')
    visit.until('time is stopped', lambda: visit.find('button[title="resume time"]'))
    before = time_ns(visit.arguments)
    visit.press('advance by 10 ms')
    visit.until('ten ticks were stepped', lambda: time_ns(visit.arguments) - before in range(9_000_001, 10_000_001))
    time.sleep(0.3)
    if time_ns(visit.arguments) - before > 10_000_000:
        fail('time goes on though it was stopped')
    visit.press('resume time')
    visit.until('time goes on', lambda: time_ns(visit.arguments) - before > 20_000_000)


def a_signal_is_held(visit):
    visit.show('Signals')
    visit.until('inputs are there', lambda: visit.find('button.signal'))
    button = visit.find('button.signal')[0]
    name = button.find_element(By.CSS_SELECTOR, 'span + span, span:nth-of-type(2)').text
    device = visit.texts('.device h2')[0]
    button.click()
    visit.until(f'{name} is held', lambda: control(visit.arguments, 'get', f'{device}.{name}')['values'][f'{device}.{name}'] == 1)
    visit.until('and shown so', lambda: visit.find('button.signal')[0].get_attribute('aria-pressed') == 'true')
    visit.find('button.signal')[0].click()
    visit.until(f'{name} is let go', lambda: visit.find('button.signal')[0].get_attribute('aria-pressed') == 'false')


def a_fault_comes_and_goes(visit):
    visit.show('Axes')
    device, axis = visit.texts('.device h2')[0], visit.texts('.axis h3')[0]
    visit.press(f'break {device}.{axis}')
    visit.until('the form is there', lambda: visit.find('.fault_form button[type=submit]'))
    visit.find('.fault_form button[type=submit]')[0].click()
    visit.until('a fault is in force', lambda: len(control(visit.arguments, 'list')['faults']) == 1)
    visit.until('and shown at its axis', lambda: visit.find('button[title^="clear fault"]'))
    visit.find('button[title^="clear fault"]')[0].click()
    visit.until('and cleared', lambda: not control(visit.arguments, 'list')['faults'])
