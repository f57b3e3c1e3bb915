"""Does what a person does in each panel of the live page, beside a host, and checks the results (for live.py)."""
import json
import pathlib
import subprocess
import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import browse
import firefox

BENCH = """understudy: 1
lines:
  rs485:
    link: ./host.port
    stations: [ { device: feeder, address: 1 } ]
devices:
  feeder: { model: simple2-r3, nv: { DIN4_Aaxis_Home: 1 } }
plant:
  feeder.A: { travel: [-40000, 40000], home: { at: -30000, width: 200 }, limits: { lower: -35000, upper: 35000 }, encoder: { per_revolution: 4000 } }
"""
LISTING = '        Delay_mSec 60000\n        END\n'


def enter(visit, label, text):
    """Types into the field with that label, and presses Enter."""
    field = visit.find(f'input[aria-label^="{label}"]')[0]
    field.send_keys(Keys.CONTROL + 'a')
    field.send_keys(text, Keys.ENTER)
    return field


def select(visit, label, value):
    visit.until(f'there is a choice: {label}', lambda: visit.find(f'select[aria-label="{label}"]'))
    chosen = visit.find(f'select[aria-label="{label}"]')[0]
    visit.driver.execute_script("arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('change', { bubbles: true }))",
                                chosen, value)


def saved(visit, name, press):
    """Returns the file that the browser saves when a button is pressed, as bytes."""
    visit.driver.execute_script("""
        window.kept = null;
        window.createBefore ??= URL.createObjectURL;
        URL.createObjectURL = (blob) => { new Response(blob).arrayBuffer().then((bytes) => { window.kept = [...new Uint8Array(bytes)]; });
                                          return window.createBefore.call(URL, blob); };""")
    visit.press(press)
    visit.until(f'{name} is saved', lambda: visit.driver.execute_script('return window.kept && window.kept.length'))
    return bytes(visit.driver.execute_script('return window.kept'))


def axes(visit, stage):
    """The rail shows the target, switches and lost steps, all controlled by the mouse."""
    unused = lambda: visit.texts('.switch .unused')
    visit.until('a limit switch that the device does not use is said to be so, and no other', lambda: sorted(unused()) ==
                ['wired, not used: DIN2_Aaxis_UP_Limit = 0', 'wired, not used: DIN3_Aaxis_DN_Limit = 0'])
    visit.picture('unused')
    stage.host_writes(0x0A06, 1)
    visit.until('until it does', lambda: unused() == ['wired, not used: DIN3_Aaxis_DN_Limit = 0'])
    stage.host_writes(0x0A06, 0)
    stage.host_writes(0x1014, 1)
    stage.host_writes(0x1000, 30000, 0, 20, 5, 5, 1)  # 30,000 pulses, which take half a minute
    visit.until('the target is told', lambda: any('30,000' in text for text in visit.texts('.reading')) and visit.find('.rail .target'))
    visit.picture('target')
    visit.press('break feeder.A')
    select(visit, 'kind of fault', 'lost_steps')
    visit.until('the form asks how many', lambda: visit.texts('.fault_form .fields label span') == ['one in *'])
    visit.find('.fault_form .fields input')[0].send_keys('10')
    visit.find('.fault_form button[type=submit]')[0].click()
    visit.until('steps are lost', lambda: 'lost' in ' '.join(visit.texts('.axis .lamps')) and stage.value('feeder.A.lost') > 0)
    visit.until('the commanded place is a ghost', lambda: visit.find('.rail .ghost'))
    visit.picture('ghost')
    visit.press('home of A, DIN_4: stuck on')
    visit.until('the switch is stuck', lambda: stage.value('feeder.DIN_4') == 1 and visit.find('button[title="home of A, DIN_4: clear the fault"]'))
    visit.press('home of A, DIN_4: clear the fault')
    visit.until('and mended', lambda: stage.value('feeder.DIN_4') == 0)
    stage.host_writes(0x100E, 1)
    visit.until('the axis stands', lambda: stage.value('feeder.A.speed') == 0)
    visit.press('break feeder.A')
    select(visit, 'kind of fault', 'slip')
    before = stage.value('feeder.A.position')
    visit.until('a slip asks how far', lambda: visit.texts('.fault_form .fields label span') == ['pulses *'])
    visit.find('.fault_form .fields input')[0].send_keys('-500')
    visit.find('.fault_form button[type=submit]')[0].click()
    visit.until('the carriage has slipped', lambda: stage.value('feeder.A.position') == before - 500)
    if not isinstance(visit.driver, firefox.Firefox):  # which has no mouse here
        before = stage.value('feeder.A.position')
        carriage = visit.find('.rail .carriage')[0]
        ActionChains(visit.driver).move_to_element(carriage).click_and_hold().move_by_offset(-30, 0).move_by_offset(-10, 0).release().perform()
        visit.until('the carriage slips by the mouse', lambda: before - 6000 < stage.value('feeder.A.position') < before - 500)
    zone = visit.find('.rail .zone.home')[0]
    visit.driver.execute_script("arguments[0].dispatchEvent(new MouseEvent('click', { bubbles: true }))", zone)
    visit.until('a zone is pressed on the rail itself', lambda: stage.value('feeder.DIN_4') == 1)


def signals(visit, stage):
    visit.show('Signals')
    slider = lambda: visit.find('input[type=range][aria-label="AIN_A"]')[0]
    visit.until('there is a slider', slider)
    slider().send_keys(Keys.END)
    visit.until('a slider sets a voltage by the keyboard', lambda: stage.value('feeder.AIN_A') == 12000)
    enter(visit, 'set AIN_A', '2500')
    visit.until('and a number to the millivolt', lambda: stage.value('feeder.AIN_A') == 2500)
    dip = lambda: next(it for it in visit.find('button.signal') if it.text.startswith('DIP1'))
    dip().click()
    visit.until('a DIP switch is a switch', lambda: stage.value('feeder.DIP1') == 1 and dip().get_attribute('aria-pressed') == 'true')
    enter(visit, 'find a signal', 'home')
    visit.until('found by what it is used for', lambda: len(visit.find('.signal')) == 1 and 'DIN_4' in visit.texts('.signal')[0])


def plot(visit, stage):
    visit.show('Plot')
    enter(visit, 'a name to plot', 'feeder.A.sped')
    visit.until('a wrong name is said to be wrong', lambda: 'sped' in visit.texts('.said')[0])
    enter(visit, 'a name to plot', 'feeder.A.speed')
    visit.until('a second curve', lambda: len(visit.find('.curve')) == 2)
    stage.host_writes(0x1014, 1)
    stage.host_writes(0x1000, 6400, 0, 60, 5, 5, 1)
    visit.show('Signals')
    time.sleep(0.5)
    visit.show('Axes')
    visit.show('Plot')
    time.sleep(1)
    visit.press('freeze the plot')
    first = saved(visit, 'a CSV', 'save as CSV').decode()
    time.sleep(0.5)
    if saved(visit, 'the same CSV', 'save as CSV').decode() != first:
        browse.fail('a plot that is frozen changes')
    lines = first.splitlines()
    if lines[0] != 'time_s,feeder.A.position,feeder.A.speed' or len(lines) < 20:
        browse.fail(f'what is this CSV: {lines[:3]}')
    places = [int(line.split(',')[1]) for line in lines[1:] if line.split(',')[1]]
    if places != sorted(places):
        browse.fail('an axis that only goes forward is drawn going back: an old value')
    picture = saved(visit, 'a picture', 'save as a picture')
    if not picture.startswith(b'\x89PNG'):
        browse.fail('the picture is no PNG')
    visit.picture('plot')
    visit.press('freeze the plot')
    field = visit.find('input[aria-label="condition of the trigger"]')[0]
    field.send_keys('feeder.A.pulses >= 9000')
    select(visit, 'time before and after the trigger', '500ms')
    visit.press('arm the trigger')
    visit.until('the trigger is armed', lambda: 'armed' in ' '.join(visit.texts('output')))
    stage.host_writes(0x1000, 6400, 0, 60, 5, 5, 1)
    visit.until('the shot is there', lambda: visit.find('button[title="back to the running plot"]'))
    shot = [line.split(',') for line in saved(visit, 'the shot', 'save as CSV').decode().splitlines()[1:]]
    steps = {round(float(b[0]) - float(a[0]), 6) for a, b in zip(shot, shot[1:])}
    if steps != {0.001} or not -0.51 < float(shot[0][0]) < -0.4 or not 0.4 < float(shot[-1][0]) < 0.51:
        browse.fail(f'a shot of every tick around its moment? {shot[0]}, {shot[-1]}, {steps}')
    at = next(row for row in shot if float(row[0]) >= 0)
    if not 9000 <= float(at[1]) < 9100:
        browse.fail(f'the moment is not where the condition becomes true: {at}')
    visit.picture('shot')


def registers(visit, stage):
    visit.show('Registers')
    row = lambda name: next(it for it in visit.find('.registers tbody tr') if it.find_element(By.CSS_SELECTOR, '.name').text == name)
    said = lambda name: row(name).find_element(By.CSS_SELECTOR, '.by').text
    enter(visit, 'find a register', '0x0000')
    visit.until('bits have names', lambda: 'A_moving' in row('STATUS').text)
    enter(visit, 'find a register', 'Aaxis_Speed')
    visit.until('found by name, with its section', lambda: row('Aaxis_Speed') and 'motion' in row('Aaxis_Speed').text)
    stage.host_writes(0x1002, 321)
    visit.until('a write of the host is told as its', lambda: said('Aaxis_Speed').startswith('host'))
    row('Aaxis_Speed').find_element(By.CSS_SELECTOR, 'input').send_keys('123', Keys.ENTER)
    visit.until('one of the page as the page\'s', lambda: said('Aaxis_Speed').startswith('page') and stage.value('feeder.Aaxis_Speed') == 123)
    row('Aaxis_Speed').find_element(By.CSS_SELECTOR, 'input').send_keys('40000', Keys.ENTER)
    visit.until('a value out of range is refused in the check\'s words', lambda: '32768' in visit.texts('.said')[0])
    enter(visit, 'find a register', '0x0E04')
    visit.until('found by number', lambda: row('Cord_A'))
    for words in ['acceleration time of axis B', 'B 軸加速時間']:
        enter(visit, 'find a register', words)
        visit.until(f'found by what it stands for: {words}', lambda: visit.texts('.registers .name') == ['Baxis_AccTime'] and
                    'B 軸加速時間' in row('Baxis_AccTime').text and 'acceleration' in row('Baxis_AccTime').text)
    enter(visit, 'find a register', '0x0E04')
    visit.until('found by number again', lambda: row('Cord_A'))
    stage.host_writes(0x1014, 1)
    stage.host_writes(0x1000, 6400, 0, 60, 5, 5, 1)
    visit.until('the device\'s own changes are the device\'s', lambda: said('Cord_A') == 'device')
    writes = lambda: int(visit.texts('.count')[0].replace(',', ''))
    before = writes()
    stage.host_writes(0xF000, 61)
    visit.until('writes of the EEPROM are counted', lambda: writes() == before + 1)
    enter(visit, 'find a register', Keys.DELETE)
    visit.find('.check input')[0].click()
    expected = {'Aaxis_Speed', 'Aaxis_SVON', 'Aaxis_Pulse', 'Aaxis_AccTime', 'Aaxis_DecTime', 'Aaxis_Move_INC', 'Aaxis_Home_Speed'}
    visit.until('only what the host uses, each of several in one request', lambda: expected <= set(visit.texts('.registers .name')))
    if 'Cord_A' in visit.texts('.registers .name'):
        browse.fail('a register that no host has asked for is shown as if one had')
    visit.picture('heard')


def bus(visit, stage):
    visit.show('Bus')
    stage.host_writes(0x1002, 200)
    visit.until('frames are told in words', lambda: any('feeder.Aaxis_Speed = 200' in text for text in visit.texts('.frames .words')))
    visit.until('with their latency', lambda: any('ms' in text for text in visit.texts('.frames .out .figure')))
    for side, comes in [('request', 200), ('reply', 201)]:
        visit.press(f'drop the next {side} like this')
        visit.until(f'a drop of a {side} waits', lambda: len(browse.control(visit.arguments, 'list')['faults']) == 1)
        stage.host_tries(0x1002, 201)
        words = 'not received' if side == 'request' else 'not sent'
        visit.until('the next one is dropped, and why is told', lambda: any(f'drop: {words}' in text for text in visit.texts('.frames .words')))
        if stage.value('feeder.Aaxis_Speed') != comes:
            browse.fail(f'a {side} was to be dropped: {stage.value("feeder.Aaxis_Speed")}')
        visit.find('button[title^="clear fault"]')[0].click()
        visit.until('and mended', lambda: not browse.control(visit.arguments, 'list')['faults'])
    select(visit, "which of the next frames a row's button drops", '3')
    visit.press('drop the 3rd next reply like this')
    visit.until('a later one can be dropped too', lambda: any('nth=3' in it['fault'] for it in browse.control(visit.arguments, 'list')['faults']))
    browse.control(visit.arguments, 'clear')
    stage.host_tries(0x1002, 60000)
    visit.until('an exception stands out', lambda: visit.find('.frames tr.bad'))
    select(visit, 'which frames', 'exceptions')
    visit.until('a filter leaves exceptions alone', lambda: len(visit.find('.frames tbody tr')) == len(visit.find('.frames tr.bad')) > 0)
    select(visit, 'which frames', 'all')
    visit.picture('bus')
    capture = saved(visit, 'a capture', 'save these frames as a capture')
    if capture[:4] != b'\x0a\x0d\x0d\x0a':
        browse.fail('the capture is no pcapng')
    file = pathlib.Path(stage.folder, 'bus.pcapng')
    file.write_bytes(capture)
    decoded = subprocess.run(['tshark', '-r', file, '-Y', 'mbrtu && modbus.func_code == 6'], capture_output=True, text=True, check=True).stdout
    if len(decoded.splitlines()) < 4:
        browse.fail(f'Wireshark does not decode it: {decoded}')
    enter(visit, 'bytes of a request', '01 03 10 02 00 01')
    visit.until('a request by hand is answered', lambda: any('feeder.Aaxis_Speed = 201' in text for text in visit.texts('.frames .out .words')))
    visit.press('pause the list')
    before = visit.texts('.frames .words')
    stage.host_writes(0x1002, 222)
    time.sleep(0.5)
    if visit.texts('.frames .words') != before:
        browse.fail('a list that is held still moves')
    visit.press('pause the list')
    visit.until('and it goes on', lambda: any('222' in text for text in visit.texts('.frames .words')))


def program(visit, stage):
    visit.show('Program')
    visit.until('there is no program yet', lambda: 'There is no program' in visit.driver.find_element(By.ID, 'panel').text)
    visit.press('change the program')
    area = lambda: visit.find('textarea')[0]
    area().send_keys('        NONSENSE 1\n')
    visit.press('load this text')
    visit.until('a mistake is told with its line', lambda: any('line 1' in text for text in visit.texts('.bad')))
    visit.driver.execute_script("const it = arguments[0]; it.focus(); it.select(); document.execCommand('insertText', false, arguments[1])", area(), LISTING)
    visit.press('load this text')
    visit.until('a program is loaded', lambda: len(visit.find('.listing li')) == 2)
    visit.press('start at line 0')
    visit.until('the line that runs is marked', lambda: 'Delay_mSec' in ' '.join(visit.texts('.listing .running')))
    visit.until('what it waits for, and how long still', lambda: 'its delay' in visit.texts('.programs')[0] and 'another 5' in visit.texts('.programs')[0])
    enter(visit, 'another value to show', 'Cord_A')
    visit.until('a value of one\'s own is beside it', lambda: 'Cord_A' in visit.texts('.values tr')[0])
    visit.picture('runs')
    visit.press('stop: PROG_MAIN_RunTime_END=1')
    visit.until('it is stopped', lambda: 'stopped' in visit.texts('.programs')[0])


def faults(visit, stage):
    visit.show('Faults')
    enter(visit, 'run until a condition', 'time >= 100000s &&')
    visit.until('a wrong condition is said to be wrong', lambda: visit.texts('.said')[0])
    stage.host_writes(0x1014, 1)
    stage.host_writes(0x1000, 32000, 0, 60, 5, 5, 1)
    enter(visit, 'run until a condition', 'feeder.A.pulses >= 20000')
    visit.until('time runs until then, and stands', lambda: 20000 <= stage.value('feeder.A.pulses') < 20010)
    enter(visit, 'save a snapshot', 'here')
    visit.until('a snapshot is kept', lambda: visit.find('button[title="restore here"]'))
    enter(visit, 'save a snapshot', '<img src=x onerror=alert(1)>')
    visit.until('a name is a name, whatever it holds', lambda: '<img src=x onerror=alert(1)>' in visit.texts('.named b') and not visit.find('.named img'))
    visit.press('advance by 1 s')
    visit.until('a second later', lambda: stage.value('feeder.A.pulses') > 22000)
    visit.press('restore here')
    visit.until('back again', lambda: 20000 <= stage.value('feeder.A.pulses') < 20010)
    select(visit, 'speed of time', '0.1')
    visit.press('resume time')
    begin, before = time.monotonic(), browse.time_ns(visit.arguments)
    time.sleep(1)
    ratio = (browse.time_ns(visit.arguments) - before) / 1e9 / (time.monotonic() - begin)
    if not 0.05 < ratio < 0.15:
        browse.fail(f'a tenth of the speed? {ratio}')
    select(visit, 'speed of time', 'real')
    select(visit, 'kind of fault', 'drop')
    visit.find('.fault_form .check input')[0].click()
    visit.until('the trigger has fields', lambda: len(visit.find('.fault_form .fields label')) > 4)
    field = lambda name: next(it for it in visit.find('.fault_form .fields label') if it.text.split('\n')[0] == name)
    if field('of').find_element(By.CSS_SELECTOR, 'select').get_attribute('value') != 'reply':
        browse.fail('the form does not show which side is dropped')
    field('function').find_element(By.CSS_SELECTOR, 'input').send_keys('6')
    visit.until('the form says what it will inject', lambda: visit.texts('.fault_form .will') == ['drop feeder function=6'])
    visit.find('.fault_form button[type=submit]')[0].click()
    visit.until('a fault waits', lambda: any('function' in text for text in visit.texts('.scroll td')))
    stage.host_tries(0x1002, 201)
    visit.until('its hits are counted', lambda: browse.control(visit.arguments, 'list')['faults'][0]['hits'] >= 1)
    visit.picture('faults')
    visit.press('power of feeder: off')
    visit.until('the power is off', lambda: stage.value('feeder.power') == 0 and 'no power' in visit.texts('.models')[0])
    visit.press('power of feeder: on')
    visit.until('and on', lambda: stage.value('feeder.power') == 1)
    visit.until('all of it is told below', lambda: {'inject', 'power', 'restored'} <= set(visit.texts('.events td:nth-child(2)')))


def keyboard(visit, stage):
    """Without a mouse, each panel is reached by the arrow keys, and a signal and the clock by Tab and Space."""
    driver = visit.driver
    active = lambda what: driver.execute_script(f'return document.activeElement.{what}')
    visit.find('#tab_Axes')[0].send_keys(Keys.ARROW_RIGHT)
    visit.until('an arrow goes to the next panel', lambda: active('id') == 'tab_Signals' and visit.find('.signal'))
    for _ in range(4):
        driver.switch_to.active_element.send_keys(Keys.TAB)
        if 'DIN_0' in (active('textContent') or ''):
            break
    driver.switch_to.active_element.send_keys(Keys.SPACE)
    visit.until('Tab and Space hold an input', lambda: stage.value('feeder.DIN_0') == 1)
    visit.find('#tab_Signals')[0].send_keys(Keys.END)
    visit.until('End goes to the last panel', lambda: active('id') == 'tab_Faults')
    visit.find('button.pause')[0].send_keys(Keys.ENTER)
    visit.until('Enter stops time', lambda: browse.control(visit.arguments, 'status')['status']['paused'])
    nameless = driver.execute_script("""
        return [...document.querySelectorAll('button, input, select, textarea, canvas, svg[role], [role=img]')]
          .filter((it) => !(it.getAttribute('aria-label') || it.title || it.textContent.trim() || it.closest('label')))
          .map((it) => it.outerHTML.slice(0, 120))""")
    if nameless:
        browse.fail(f'nothing is said of these: {json.dumps(nameless)}')


def keeps(visit, stage):
    """What was typed, chosen, armed or frozen survives a change of the panel and, unless it is large, a reload."""
    value = lambda selector: visit.find(selector)[0].get_attribute('value')
    visit.press('break feeder.A')
    select(visit, 'kind of fault', 'slip')
    visit.until('a slip asks how far', lambda: visit.texts('.fault_form .fields label span') == ['pulses *'])
    visit.find('.fault_form .fields input')[0].send_keys('-77')
    visit.show('Signals')
    visit.find('input[aria-label^="set AIN_A"]')[0].send_keys('12')
    visit.find('input[aria-label="find a signal"]')[0].send_keys('DIN_1')
    visit.show('Plot')
    enter(visit, 'a name to plot', 'feeder.A.speed')
    visit.until('a second curve', lambda: len(visit.find('.curve')) == 2)
    visit.find('input[aria-label="condition of the trigger"]')[0].send_keys('feeder.A.pulses >= 900000')
    visit.press('arm the trigger')
    visit.until('the trigger is armed', lambda: 'armed' in ' '.join(visit.texts('output')))
    visit.press('freeze the plot')
    frozen = saved(visit, 'a CSV', 'save as CSV')
    visit.show('Registers')
    select(visit, 'section of the manual', '2')
    section = value('select[aria-label="section of the manual"]')
    visit.find('input[aria-label^="find a register"]')[0].send_keys('Aaxis_Sp')
    visit.until('a register is found', lambda: 'Aaxis_Speed' in visit.texts('.registers .name'))
    visit.find('input[aria-label="write Aaxis_Speed"]')[0].send_keys('77')
    visit.show('Bus')
    visit.find('input[aria-label="find in frames"]')[0].send_keys('Speed')
    select(visit, 'which frames', 'in')
    visit.find('input[aria-label^="bytes of a request"]')[0].send_keys('01 03')
    visit.show('Program')
    visit.press('change the program')
    visit.find('textarea')[0].send_keys('half a line')
    visit.show('Faults')
    select(visit, 'kind of fault', 'drop')
    visit.find('.fault_form .check input')[0].click()
    visit.until('the trigger has fields', lambda: len(visit.find('.fault_form .fields label')) > 4)
    field = lambda: next(it for it in visit.find('.fault_form .fields label') if it.text.split('\n')[0] == 'function').find_element(By.CSS_SELECTOR, 'input')
    field().send_keys('6')

    def all_is_there(when, is_whole):
        visit.until(f'{when}: a fault that is half filled in', lambda: field().get_attribute('value') == '6' and value('select[aria-label="kind of fault"]') == 'drop')
        visit.show('Axes')
        visit.until('the form at an axis', lambda: value('.fault_form .fields input') == '-77')
        visit.show('Signals')
        visit.until('the filter', lambda: value('input[aria-label="find a signal"]') == 'DIN_1')
        enter(visit, 'find a signal', Keys.DELETE)
        visit.until('a number that was not sent', lambda: value('input[aria-label^="set AIN_A"]') == '12')
        visit.find('input[aria-label="find a signal"]')[0].send_keys('DIN_1')
        visit.show('Plot')
        visit.until('the curves', lambda: len(visit.find('.curve')) == 2)
        visit.until('the trigger, armed, with its condition', lambda: visit.find('button[title="disarm the trigger"]') and
                    value('input[aria-label="condition of the trigger"]') == 'feeder.A.pulses >= 900000')
        if is_whole and saved(visit, 'the same CSV', 'save as CSV') != frozen:
            browse.fail('a frozen plot is another after a look elsewhere')
        visit.show('Registers')
        visit.until('what was looked for', lambda: value('input[aria-label^="find a register"]') == 'Aaxis_Sp' and
                    value('select[aria-label="section of the manual"]') == section)
        visit.until('and typed', lambda: value('input[aria-label="write Aaxis_Speed"]') == '77')
        visit.show('Bus')
        visit.until('the filters', lambda: value('input[aria-label="find in frames"]') == 'Speed' and value('select[aria-label="which frames"]') == 'in' and
                    value('input[aria-label^="bytes of a request"]') == '01 03')
        visit.show('Program')
        visit.until('the text that was edited', lambda: 'half a line' in value('textarea'))
        visit.show('Faults')

    all_is_there('elsewhere and back', True)
    time.sleep(0.5)
    visit.driver.refresh()
    visit.until('after a reload the panel is the same', lambda: visit.driver.find_element(By.ID, 'tab_Faults').get_attribute('aria-selected') == 'true' and
                visit.find('.fault_form'))
    all_is_there('after a reload', False)
    visit.picture('kept')


PARTS = {'keeps': keeps, 'axes': axes, 'signals': signals, 'plot': plot, 'registers': registers, 'bus': bus, 'program': program, 'faults': faults,
         'keyboard': keyboard}
