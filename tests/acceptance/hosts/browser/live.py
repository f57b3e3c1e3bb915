#!/usr/bin/env python3
"""Tests the live page with a real browser, a host on the line, and failures between them.

live.py UNDERSTUDY [--only PART]... [--pictures FOLDER]: starts daemons and pages itself; prints a line for each thing
seen; exits with 1 at the first that is not so. Needs chromium, chromium-driver, python3-selenium and mbpoll.
"""
import argparse
import functools
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import tty
import types

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import browse
import doing

MODELS = ['simple2-r3', 'super-40nc', 'rs-m8194h', 'slim']
BROWSERS = 16
# For a recording: only buttons that display something, or that belong to the browser.
HARMLESS = re.compile('save|freeze|scale|remove|pause the list|read it again|next|previous|back|the choice|clear the path|pcapng|close|go to|zoom|earlier|later|whole|dragging marks|list what')

BENCH = """understudy: 1
lines:
  rs485:
    link: ./host.port
    stations: [ { device: feeder, address: 1 } ]
devices:
  feeder: { model: simple2-r3, nv: { DIN4_Aaxis_Home: 1 } }
plant:
  feeder.A: { home: { at: 900000000, width: 200 } }
"""

FAILING = """understudy: 1
name: ends elsewhere
bench:
  lines:
    rs485:
      stations: [ { name: feeder, model: simple2-r3, address: 1 } ]
steps:
  - write: { feeder.Aaxis_SVON: 1 }
  - write: { feeder.Aaxis_Pulse: 32000, feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5, feeder.Aaxis_DecTime: 5, feeder.Aaxis_Move_INC: 1 }
  - wait: { until: "feeder.STATUS.4 == 0", within: 20s }
  - expect: { feeder.Cord_A: 32001 }
"""


class Stage:
    """A daemon, its page, and a folder for both."""

    def __init__(self, options, *serve):
        self.options = options
        self.room = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.room.name)
        self.control = str(self.folder / 'control')
        self.serve = serve
        self.daemon = self.page = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in (self.page, self.daemon):
            if process:
                process.send_signal(signal.SIGCONT)
                process.terminate()
                process.wait()
        self.room.cleanup()

    def start(self, *words):
        return subprocess.Popen([self.options.understudy, *words], stdout=subprocess.PIPE, text=True, cwd=self.folder)

    def start_daemon(self):
        self.daemon = self.start('serve', *self.serve, '--control', self.control)
        first = self.daemon.stdout.readline()
        self.port = first.split()[2] if first.startswith('ready') else ''

    def start_page(self):
        self.page = self.start('page', '--control', self.control)
        self.address = self.page.stdout.readline().split()[1]

    def start_recording(self, recording):
        self.page = self.start('replay', str(recording), '--page', '--control', self.control)
        for line in self.page.stdout:
            if line.startswith('page '):
                self.address = line.split()[1]
                return

    def visit(self, width=1400, height=900, dark=False, prefix='', in_firefox=False):
        return browse.Visit(types.SimpleNamespace(address=self.address, control=self.control, prefix=prefix,
                            understudy=self.options.understudy, pictures=self.options.pictures), width, height, dark, in_firefox)

    def value(self, name):
        return browse.control(types.SimpleNamespace(understudy=self.options.understudy, control=self.control),
                              'get', name)['values'][name]

    def host_writes(self, register, *values):
        self.host_tries(register, *values, check=True)

    def host_tries(self, register, *values, check=False):
        subprocess.run(['mbpoll', '-m', 'rtu', '-a', '1', '-b', '19200', '-P', 'even', '-0', '-q', '-t', '4', '-r',
                        str(register), self.port, *map(str, values)], check=check, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def panels(options, model):
    """Checks every panel of a model, light and dark, wide and narrow."""
    with Stage(options, '--model', model) as stage:
        stage.start_daemon()
        stage.start_page()
        for width, height, dark in [(1400, 900, False), (390, 844, True), (1400, 900, True), (390, 844, False)]:
            visit = stage.visit(width, height, dark, f'{model}_')
            browse.look_at_panels(visit)
            if width > 700 and not dark:
                browse.time_stands_and_goes(visit)
                if visit.find('button.signal'):
                    browse.a_signal_is_held(visit)
                browse.a_fault_comes_and_goes(visit)
            visit.close()


def host(options):
    """A host moves an axis; pressing a switch ends homing; stopping the clock stops the axis."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'bench.yaml').write_text(BENCH, encoding='utf-8')
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        shown = lambda: int(visit.texts('.axis output.figure')[0].replace(',', ''))
        stage.host_writes(0x1014, 1)
        stage.host_writes(0x1000, 0, 1, 100, 5, 5, 1)  # 65,536 pulses at 100 RPM
        visit.until('the axis moves as the host said', lambda: shown() > 2000)
        visit.picture('moving')
        visit.press('stop time')
        visit.until('time is stopped', lambda: visit.find('button[title="resume time"]'))
        time.sleep(0.3)
        before = shown()
        time.sleep(0.5)
        if shown() != before:
            browse.fail('the axis moves though time stands')
        visit.press('resume time')
        visit.until('and moves on', lambda: shown() > before)
        visit.show('Bus')
        visit.until('the bus says what was written', lambda: any('Aaxis_SVON' in text for text in visit.texts('.frames .words')))
        visit.show('Axes')
        stage.host_writes(0x100E, 1)
        visit.until('the axis stands', lambda: stage.value('feeder.A.speed') == 0)
        stage.host_writes(0xF000, 60)
        stage.host_writes(0xF010, 1)
        stage.host_writes(0x1011, 1)
        visit.until('it looks for its home', lambda: stage.value('feeder.A.speed') != 0)
        switch = lambda: visit.find('button[title^="home of A"][title$="hold or release"]')[0]
        visit.until('its home switch can be pressed', switch)
        switch().click()
        visit.until('the switch is held', lambda: switch().get_attribute('aria-pressed') == 'true')
        time.sleep(0.3)
        switch().click()
        visit.until('the homing is over', lambda: stage.value('feeder.A.speed') == 0 and stage.value('feeder.STATUS.4') == 0)
        visit.close()


def before(options):
    """A host uses registers before a browser connects: the page knows them all the same."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'bench.yaml').write_text(BENCH, encoding='utf-8')
        stage.start_daemon()
        stage.host_writes(0x1002, 123)
        stage.start_page()
        visit = stage.visit()
        visit.show('Registers')
        visit.find('.check input')[0].click()
        visit.until('what the host has used before is there', lambda: visit.texts('.registers .name') == ['Aaxis_Speed'])
        visit.close()


def burst(options):
    """There are more frames than a page can accept: it shows how many are missing, and where."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'bench.yaml').write_text(BENCH.replace('link:', 'timing: instant\n    link:'), encoding='utf-8')
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        visit.show('Bus')
        doing.select(visit, 'which frames', 'exceptions')  # so that the frames after the hole do not fill the list
        port = os.open(stage.port, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(port)
        request, end = bytes.fromhex('010300010001D5CA'), time.monotonic() + 3 * browse.PATIENCE_S
        while not visit.find('.frames .missed') and time.monotonic() < end:
            stage.page.send_signal(signal.SIGSTOP)  # it is slow, and the daemon keeps 1,024 frames meanwhile
            for _ in range(700):
                os.write(port, request)
                answer = b''
                while len(answer) < 7:
                    answer += os.read(port, 7 - len(answer))
            stage.page.send_signal(signal.SIGCONT)
            time.sleep(0.5)
        os.close(port)
        visit.until('a row tells of those that are missing', lambda: any('frames not shown' in text for text in visit.texts('.frames .missed')))
        visit.until('and how many in all', lambda: 'not shown' in visit.texts('.bar .count')[0])
        visit.picture('burst')
        doing.select(visit, 'which frames', 'all')
        capture = doing.saved(visit, 'a capture', 'save these frames as a capture')
        if b'frames are missing before this one' not in capture:
            browse.fail('the capture does not say what is missing in it')
        visit.close()


def restart(options):
    """The daemon ends and restarts: the page says so, and recovers automatically."""
    with Stage(options, '--model', 'simple2-r3', '--link', './host.port') as stage:
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        stage.daemon.terminate()
        stage.daemon.wait()
        visit.until('the page says that the daemon has stopped', lambda: 'has stopped' in visit.texts('.said')[0])
        stage.start_daemon()
        visit.until('and that it is back', lambda: 'has stopped' not in visit.texts('.said')[0] and visit.texts('.axis h3'))
        before = visit.texts('.clock')[0]
        visit.until('with its time', lambda: visit.texts('.clock')[0] != before)
        stage.page.send_signal(signal.SIGSTOP)
        visit.until('a server that is stuck is said to be', lambda: 'server does not answer' in visit.texts('.said')[0])
        stage.page.send_signal(signal.SIGCONT)
        visit.until('and heals', lambda: visit.texts('.said')[0] == '' and visit.texts('.clock') and visit.texts('.axis h3'))
        before = visit.texts('.clock')[0]
        visit.until('time is told again', lambda: visit.texts('.clock')[0] != before)
        visit.close()


def recording(options):
    """Drags the timeline of a failed scenario's recording back and forth."""
    with Stage(options) as stage:
        (stage.folder / 'failing.yaml').write_text(FAILING, encoding='utf-8')
        subprocess.run([options.understudy, 'run', 'failing.yaml', '--record', 'kept'], cwd=stage.folder, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        kept = next(stage.folder.glob('kept/**/*.jsonl'))
        stage.start_recording(kept)
        visit = stage.visit()
        shown = lambda: int(visit.texts('.axis output.figure')[0].replace(',', ''))
        bar = lambda: visit.find('.travel input[type=range]')[0]
        drag = lambda to: visit.driver.execute_script(
            'const it = arguments[0]; it.value = arguments[1] * it.max; '
            "it.dispatchEvent(new Event('input', { bubbles: true })); it.dispatchEvent(new Event('change', { bubbles: true }));",
            bar(), to)
        visit.until('there is a bar', bar)
        visit.until('with the failure on it', lambda: visit.find('.travel .marks .failed'))
        for panel in browse.PANELS:
            visit.show(panel)
            time.sleep(0.3)
            for button in visit.find('#panel button:not([disabled])'):
                title = button.get_attribute('title') or button.text
                if not HARMLESS.search(title):
                    browse.fail(f'in a recording, which nothing changes, {panel} has a button: {title}')
        visit.show('Axes')
        for to, fits in [(1, lambda: shown() == 32000), (0.5, lambda: 0 < shown() < 32000), (0, lambda: shown() == 0),
                         (0.5, lambda: 0 < shown() < 32000), (1, lambda: shown() == 32000)]:
            drag(to)
            visit.until(f'at {to} of it the axis is where it was', fits)
        visit.show('Bus')
        visit.until('frames are there', lambda: len(visit.find('.frames tbody tr')) > 0)
        drag(0)
        visit.until('and forgotten where they have not been yet', lambda: len(visit.find('.frames tbody tr')) <= 1)
        visit.press('forward by one frame')
        visit.until('the next frame is gone to', lambda: visit.find('.frames tbody tr'))
        visit.show('Axes')
        keys = lambda text: visit.driver.find_element(By.CSS_SELECTOR, '.travel button').send_keys(text)
        drag(0)
        visit.until('it begins at nought', lambda: visit.texts('.clock')[0] == '0.000 s')
        keys(']]')
        visit.until('a key goes on by frames', lambda: visit.texts('.clock')[0] > '0.000 s')
        drag(0.5)
        visit.until('to the middle', lambda: visit.texts('.clock')[0].startswith('1.5'))
        before = visit.texts('.clock')[0]
        keys(',,,')
        visit.until('another some ticks back', lambda: visit.texts('.clock')[0] < before)
        bar().send_keys(Keys.END)
        visit.until('and go to the end', lambda: shown() == 32000)
        visit.until('the failure is told', lambda: any('expected 32001' in text for text in visit.texts('.travel option')))
        visit.picture('recording')
        visit.close()


def story_file(options):
    """A recording in one file: it opens at the failure without a server, goes to other moments, and is complete."""
    with Stage(options) as stage:
        (stage.folder / 'failing.yaml').write_text(FAILING, encoding='utf-8')
        for words in [['run', 'failing.yaml', '--record', 'kept'], ['replay', 'kept/ends_elsewhere.jsonl', '--export', 'story.html']]:
            subprocess.run([options.understudy, *words], cwd=stage.folder, check=False, stdout=subprocess.DEVNULL)
        stage.address = (stage.folder / 'story.html').as_uri()
        visit = stage.visit()
        clock = lambda: visit.texts('.clock')[0]
        visit.until('a file opens at the failure', lambda: clock().startswith('3.0') and 'failing.yaml:11' in visit.texts('.story strong')[0])
        visit.until('without panels of which it holds nothing', lambda: visit.texts('nav button') == ['Axes', 'Signals', 'Plot', 'Timeline', 'Bus', 'Events'])
        visit.picture('story_file')
        visit.find('.story li button')[1].click()
        visit.until('a moment of it is a link', lambda: clock() < '0.1')
        canvas = visit.find('.timeline canvas')[0]
        ActionChains(visit.driver).move_to_element(canvas).click().perform()
        visit.until('a click on its timeline goes there', lambda: '1.0' < clock() < '2.2')
        visit.show('Axes')
        visit.until('the axes are where they were', lambda: '1,000' < visit.texts('.reading.wide output')[0] < '32,000')
        visit.show('Bus')
        visit.until('with the frames before', lambda: any('Aaxis_Move_INC' in row for row in visit.texts('.frames tr')))
        visit.close()


def story(options):
    """A recording opens at its failure, with what led there; a timeline; something else is tried, and given up; a moment is a link."""
    with Stage(options) as stage:
        (stage.folder / 'failing.yaml').write_text(FAILING, encoding='utf-8')
        subprocess.run([options.understudy, 'run', 'failing.yaml', '--record', 'kept'], cwd=stage.folder, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        stage.start_recording(next(stage.folder.glob('kept/**/*.jsonl')))
        visit = stage.visit()
        clock = lambda: visit.texts('.clock')[0]
        end = lambda: clock().startswith('3.0')
        visit.until('it opens at the failure, which is told with its line', lambda: end() and 'failing.yaml:11' in visit.texts('.story strong')[0])
        visit.until('and what led there', lambda: len(visit.texts('.story li')) == 2 and 'Aaxis_Move_INC = 1' in visit.texts('.story li')[1])
        visit.until('beside the timeline', lambda: visit.find('.timeline canvas'))
        visit.picture('story')
        visit.find('.story li button')[1].click()
        visit.until('a moment of it is a link', lambda: clock() < '0.1')
        canvas = visit.find('.timeline canvas')[0]
        ActionChains(visit.driver).move_to_element(canvas).click().perform()
        visit.until('a click on the timeline goes there', lambda: '1.0' < clock() < '2.2')
        here = clock()
        canvas.send_keys('w')
        visit.until('a key zooms, and the address says where one is', lambda: 'stretch=' in visit.driver.current_url and 't=' in visit.driver.current_url)
        place = visit.driver.current_url
        visit.show('Plot')
        rows = lambda: doing.saved(visit, 'a CSV', 'save as CSV').decode().splitlines()
        visit.until('the plot has the whole curve', lambda: len(rows()) > 1000 and rows()[-1].endswith(',32000'))
        visit.driver.back()
        visit.until('back goes to the panel before', lambda: visit.driver.find_element(By.ID, 'tab_Timeline').get_attribute('aria-selected') == 'true')
        visit.driver.get('about:blank')
        visit.driver.get(place)
        visit.until('the address alone leads to that moment', lambda: visit.find('.timeline canvas') and clock() == here)
        visit.show('Faults')
        visit.press('try what would happen from here; the recording stays as it is')
        visit.until('it is marked as altered', lambda: 'altered' in visit.texts('.time .badge')[0])
        visit.press('power of feeder: off')
        visit.until('and may be acted on', lambda: stage.value('feeder.power') == 0)
        visit.press('back to the recording')
        visit.until('until one goes back', lambda: stage.value('feeder.power') == 1 and clock() == here)
        visit.close()


def path(options):
    """A newcomer without a host: a first move; then three axes in space; groups of signals; a ladder with its values."""
    with Stage(options, '--model', 'super-40nc') as stage:
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        visit.find('button[title^="a first move"]')[0].click()
        visit.until('an axis moves, by a program that the page has loaded', lambda: stage.value('device.D8117') == 1000)
        visit.until('the page shows where it is', lambda: visit.texts('.reading.wide output')[0] != '0')
        doing.select(visit, 'third axis', 'Z')
        picture = lambda: visit.driver.execute_script('return document.querySelector(".plane canvas").toDataURL()')
        visit.until('three axes are in space', lambda: visit.find('.plane canvas.turnable'))
        before = picture()
        visit.find('.plane canvas')[0].send_keys(Keys.ARROW_RIGHT)
        visit.until('and can be turned', lambda: picture() != before)
        visit.picture('path')
        visit.show('Signals')
        groups = lambda: visit.find('details.group summary')
        visit.until('inputs are in groups', lambda: any(text.startswith('X16 to X31') for text in visit.texts('details.group summary')))
        next(it for it in groups() if it.text.startswith('X16')).click()
        visit.until('which open', lambda: any(button.text.startswith('X16') for button in visit.find('button.signal')))
        next(it for it in visit.find('button.signal') if it.text.startswith('X16')).click()
        visit.until('and say what is on and has changed', lambda: any('1 on' in text and '1 changed' in text for text in visit.texts('details.group summary')))
        visit.show('Program')
        visit.until('state registers have their meaning', lambda: any('work coordinates' in text for text in visit.texts('.values tr')))
        visit.close()


LADDER = """AREA PLC
LD X12          ; a bottle is there
ANI T0
OUT Y10
LD X12
OUT T0 K200
END
AREA C
LAB K1
TMR K100
INC D1
JMP K1
END
"""


def ladder(options):
    """Breakpoints, steps, coverage and the ladder of a program."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'ladder.lst').write_text(LADDER, encoding='utf-8')
        (stage.folder / 'bench.yaml').write_text('understudy: 1\nlines: { a: { stations: [ { name: filler, model: super-40nc, '
                                                 'program: ladder.lst, set: { M8000: 1 } } ] } }\n', encoding='utf-8')
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        visit.show('Program')
        visit.until('the file is shown, with its remarks', lambda: any('a bottle is there' in text for text in visit.texts('.listing li')))
        parts = lambda: visit.find('.ladder .part')
        name_of = lambda part: part.get_attribute('aria-label').split(';')[0]
        visit.until('the ladder has its contacts and coils', lambda: [name_of(part) for part in parts()] == [
            'line 2: LD X12', 'line 3: ANI T0', 'line 4: OUT Y10', 'line 5: LD X12', 'line 6: OUT T0 K200'])
        is_live = lambda number: 'live' in parts()[number].get_attribute('class')
        visit.until('a contact that does not conduct is dark, one that is not ON conducts', lambda: not is_live(0) and is_live(1) and not is_live(2))
        browse.control(visit.arguments, 'input', 'filler.X12=1')
        visit.until('its input makes it conduct', lambda: is_live(0) and is_live(3))
        visit.until('until the timer is over', lambda: not is_live(1) and not is_live(2) and is_live(4))
        visit.press('count the lines that run')
        visit.until('lines are counted', lambda: len(visit.find('.listing.counted .runs')) >= 8)
        visit.until('a contact that has been in one state is half covered', lambda: 'half' in parts()[3].get_attribute('class'))
        visit.press('stop at line 11')
        visit.until('time stops at a line', lambda: any('line 11: INC D1' in text for text in visit.texts('.stopped')))
        visit.until('which has a breakpoint in the list', lambda: any('filler, line 11' in text for text in visit.texts('ul.stops')))
        visit.picture('stopped')
        visit.press('to the next line')
        visit.until('a step is at the next line', lambda: any('step: filler C line' in text for text in visit.texts('.stopped')))
        after = browse.time_ns(visit.arguments)
        visit.press('back to the line before')
        visit.until('the way back leads to the line before', lambda: browse.time_ns(visit.arguments) < after)
        visit.press('delete the breakpoint at line 11')
        visit.until('it is gone', lambda: not visit.find('.stops .dot'))
        parts()[2].click()
        visit.until('a click on a coil sets one', lambda: any('filler, line 4' in text for text in visit.texts('ul.stops')))
        visit.press('continue to the next breakpoint')
        visit.until('and stops there', lambda: any('PLC line 4' in text for text in visit.texts('.stopped')))
        visit.close()


def waits(options):
    """What a host in simulated time waits for is on the timeline while it runs; here it waits for a file at last."""
    with Stage(options) as stage:
        (stage.folder / 'bench.yaml').write_text(BENCH, encoding='utf-8')
        os.mkfifo(stage.folder / 'gate')
        stage.daemon = stage.start('exec', 'bench.yaml', '--host-time', '--control', stage.control, '--', 'sh', '-c',
                                   'sleep 5; sleep 3; echo asleep no more; cat gate')
        stage.daemon.stdout.readline()
        stage.start_page()
        visit = stage.visit()
        visit.show('Timeline')
        visit.find('input[aria-label="find in the timeline"]')[0].send_keys('sleeps')
        visit.until('the timeline has the sleep of the last seconds', lambda: '1 found' in visit.texts('.bar small'))
        visit.picture('waits')
        visit.close()


def crowd(options):
    """Connects sixteen browsers, one of which never reads again, and then one more than allowed."""
    with Stage(options, '--model', 'simple2-r3', '--link', './host.port') as stage:
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit()
        driver = visit.driver
        first = driver.current_window_handle
        for number in range(2, BROWSERS + 1):
            driver.switch_to.new_window('tab')
            driver.get(stage.address)
            visit.until(f'browser {number} is there', lambda: visit.texts('.axis h3'))
        driver.execute_script('setTimeout(() => { const end = Date.now() + 8000; while (Date.now() < end); }, 50)')
        driver.switch_to.new_window('tab')
        driver.get(stage.address)
        visit.until('one too many is told so', lambda: 'too many' in visit.texts('.said')[0])
        driver.close()
        driver.switch_to.window(first)
        before = visit.texts('.clock')[0]
        visit.until('the first one goes on beside one that does not read', lambda: visit.texts('.clock')[0] != before)
        stage.value('device.A.position')
        visit.close()


def firefox(options):
    """Checks every panel in another browser, wide and narrow, light and dark, and uses some of them."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'bench.yaml').write_text(doing.BENCH, encoding='utf-8')
        stage.start_daemon()
        stage.start_page()
        for width, height, dark in [(1400, 900, False), (500, 844, True)]:
            visit = stage.visit(width, height, dark, 'firefox_', in_firefox=True)
            browse.look_at_panels(visit)
            if not dark:
                browse.time_stands_and_goes(visit)
                browse.a_signal_is_held(visit)
                browse.a_fault_comes_and_goes(visit)
                doing.axes(visit, stage)
                doing.registers(visit, stage)
            visit.close()


def does(options, part):
    """Uses one panel, with all its controls."""
    with Stage(options, 'bench.yaml') as stage:
        (stage.folder / 'bench.yaml').write_text(doing.BENCH, encoding='utf-8')
        stage.start_daemon()
        stage.start_page()
        visit = stage.visit(prefix=f'does_{part}_')
        doing.PARTS[part](visit, stage)
        visit.close()


PARTS = {**{f'does_{part}': functools.partial(does, part=part) for part in doing.PARTS}, **{f'panels_{model}': functools.partial(panels, model=model) for model in MODELS}, 'host': host, 'before': before, 'burst': burst, 'restart': restart, 'recording': recording, 'story': story, 'story_file': story_file, 'path': path, 'ladder': ladder, 'waits': waits, 'crowd': crowd, 'firefox': firefox}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('understudy', type=os.path.abspath)
    parser.add_argument('--only', action='append', choices=PARTS)
    parser.add_argument('--pictures', type=os.path.abspath)
    options = parser.parse_args()
    os.environ.setdefault('HOME', '/tmp')
    for name in options.only or PARTS:
        print(f'== {name}', flush=True)
        PARTS[name](options)


if __name__ == '__main__':
    main()
