#!/usr/bin/python3
"""Makes the pictures of docs/page.md from the running page: make_pictures.py UNDERSTUDY.

Needs chromium, chromium-driver and python3-selenium. Fonts and edges differ from machine to machine, so the pictures are
committed, and redrawn by hand when the page has changed.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

HERE = pathlib.Path(__file__).resolve().parent
SCENARIOS = HERE.parent.parent / 'scenarios'
FAILING = """understudy: 1
name: the axis arrives
bench:
  lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }
  plant: { feeder.A: { travel: [-12000, 12000], home: { at: 0, width: 200 }, limits: { lower: -10000, upper: 10000 } } }
steps:
  - write: { feeder.Aaxis_SVON: 1 }
  - write: { feeder.Aaxis_Speed: 60000 }
    exception: 3
  - write: { feeder.Aaxis_Pulse: 9000, feeder.Aaxis_Speed: 60, feeder.Aaxis_Move_INC: 1 }
  - advance: 1s
  - inject: { lost_steps: feeder.A, one_in: 10 }
  - wait: { until: feeder.STATUS.4 == 0, within: 9s }
  - assert: feeder.A.position == 9000
"""


FILLER = """AREA PLC
LD X12          ; a bottle is there
ANI T0
OUT Y10         ; the valve
LD X12
OUT T0 K2000
OUT C0 K3
LD C0
OUT Y11         ; the pusher
LD X14          ; the crate is gone
OR M1
LDI M8002
ANB
RST C0
END
"""


class Shown:
    """A command of the program that serves a page, with a browser."""

    def __init__(self, program, words, folder, height):
        self.process = subprocess.Popen([program, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True)
        address = next(found.group(1) for line in self.process.stdout if (found := re.match(r'page (http\S+)', line)))
        options = webdriver.ChromeOptions()
        for flag in ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--hide-scrollbars',
                     f'--window-size=1280,{height}', f'--user-data-dir={folder}/chromium-{height}']:
            options.add_argument(flag)
        self.browser = webdriver.Chrome(service=Service('/usr/bin/chromedriver'), options=options)
        self.browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
            'width': 1280, 'height': height, 'deviceScaleFactor': 1, 'mobile': False})
        self.browser.get(address)
        self.until(lambda: self.find('.axis h3'))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.browser.quit()
        self.process.terminate()
        self.process.wait()

    def find(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def until(self, condition):
        end = time.monotonic() + 30
        while not condition():
            assert time.monotonic() < end
            time.sleep(0.05)

    def show(self, panel):
        self.browser.find_element(By.ID, f'tab_{panel}').click()
        time.sleep(1)

    def picture(self, name):
        self.browser.save_screenshot(str(HERE / f'{name}.png'))


def main():
    program = os.path.abspath(sys.argv[1])
    os.environ['HOME'] = tempfile.gettempdir()
    with tempfile.TemporaryDirectory() as folder:
        control = f'{folder}/control'
        ctl = lambda *words: subprocess.run([program, 'ctl', '--control', control, *words], check=True,
                                            stdout=subprocess.DEVNULL)
        serve = ['serve', str(SCENARIOS / 'super40nc_quickstart.yaml'), '--links', folder, '--control', control, '--page']
        with Shown(program, serve, folder, 760) as page:
            ctl('set', 'M8000=1')
            time.sleep(1.6)
            page.picture('axes')
            page.show('Program')
            ctl('set', 'M8000=1')
            time.sleep(0.7)
            page.picture('program')
        pathlib.Path(folder, 'filler.lst').write_text(FILLER)
        pathlib.Path(folder, 'bench.yaml').write_text(
            'understudy: 1\nlines: { a: { stations: [ { name: filler, model: super-40nc, program: filler.lst } ] } }\n')
        with Shown(program, ['serve', 'bench.yaml', '--control', control, '--page'], folder, 760) as page:
            page.show('Program')
            page.find('button[title="count the lines that run"]')[0].click()
            ctl('break', 'filler', '9', 'when=filler.Y11 == 1')
            ctl('input', 'filler.X12=1')
            time.sleep(1.5)
            page.picture('ladder')
        serve = ['serve', str(SCENARIOS / 'quickstart.yaml'), '--links', folder, '--control', control, '--page']
        with Shown(program, serve, folder, 620) as page:
            host = [program, 'poll', f'{folder}/rs485.port', '--model', 'simple2-r3']
            if not os.path.exists(host[2]):
                host[2] = next(str(path) for path in pathlib.Path(folder).glob('*.port'))
            for words in [['Aaxis_SVON=1'], ['Aaxis_Pulse=-9000', 'Aaxis_Speed=100', 'Aaxis_Move_INC=1'], ['Cord_A']]:
                subprocess.run([*host, *words], check=True, stdout=subprocess.DEVNULL)
            subprocess.run([*host, 'Aaxis_Speed=60000'], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            page.show('Bus')
            page.picture('bus')
            page.show('Registers')
            page.find('.check input')[0].click()
            subprocess.run([*host, 'Aaxis_Move_INC=1'], check=True, stdout=subprocess.DEVNULL)
            time.sleep(0.4)
            page.picture('registers')
        pathlib.Path(folder, 'fails.yaml').write_text(FAILING)
        subprocess.run([program, 'run', 'fails.yaml', '--record', folder], cwd=folder, check=False, stdout=subprocess.DEVNULL)
        subprocess.run([program, 'replay', 'the_axis_arrives.jsonl', '--picture', HERE / 'story.svg'], cwd=folder, check=True)
        with Shown(program, ['replay', 'the_axis_arrives.jsonl', '--page'], folder, 640) as page:
            bar = page.find('.travel input[type=range]')[0]
            page.browser.execute_script(
                "Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set.call(arguments[0], '2100');"
                "arguments[0].dispatchEvent(new Event('input', { bubbles: true }))", bar)
            time.sleep(1)
            page.picture('recording')


if __name__ == '__main__':
    main()
