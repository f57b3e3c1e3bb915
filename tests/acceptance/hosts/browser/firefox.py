"""Controls Firefox through its own protocol (Marionette), with the part of Selenium's interface that browse.py uses,
because Debian has no geckodriver."""
import atexit
import base64
import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time

PREFERENCES = """user_pref("marionette.port", {port});
user_pref("layout.css.prefers-color-scheme.content-override", {scheme});
user_pref("browser.dom.window.dump.enabled", true);
user_pref("devtools.console.stdout.content", true);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("app.update.enabled", false);
"""
KEY = 'element-6066-11e4-a52e-4f735466cecf'  # the WebDriver standard's name of an element


class FirefoxError(Exception):
    """Firefox's error for a command that it refuses."""


class Element:
    def __init__(self, driver, name):
        self.driver = driver
        self.name = name

    def do(self, command, **more):
        return self.driver.do(command, id=self.name, **more)

    @property
    def text(self):
        return self.do('WebDriver:GetElementText')['value']

    def click(self):
        self.do('WebDriver:ElementClick')

    def get_attribute(self, name):
        return self.do('WebDriver:GetElementAttribute', name=name)['value']

    def send_keys(self, *keys):
        self.do('WebDriver:ElementSendKeys', text=''.join(keys))

    def find_element(self, by, value):
        found = self.do('WebDriver:FindElement', using=by, value=value, element=self.name)['value']
        return Element(self.driver, found[KEY])


class Firefox:
    def __init__(self, width, height, dark, program='firefox-esr'):
        self.profile = tempfile.TemporaryDirectory(prefix='firefox-')
        with socket.socket() as free:
            free.bind(('127.0.0.1', 0))
            port = free.getsockname()[1]
        pathlib.Path(self.profile.name, 'user.js').write_text(PREFERENCES.format(port=port, scheme=0 if dark else 1), encoding='utf-8')
        self.said = pathlib.Path(self.profile.name, 'said')
        with open(self.said, 'wb') as said:
            self.process = subprocess.Popen([program, '--headless', '--marionette', '--no-remote', '--profile', self.profile.name,
                                             f'--width={width}', f'--height={height}'], stdout=said, stderr=said, start_new_session=True)
        atexit.register(self.quit)  # also if a check fails
        self.input, self.last = b'', 0
        self.socket = self.connect(port)
        self.hear()
        self.do('WebDriver:NewSession', capabilities={})
        self.do('WebDriver:SetWindowRect', width=width, height=height)

    def connect(self, port):
        end = time.monotonic() + 60
        while True:
            try:
                return socket.create_connection(('127.0.0.1', port), timeout=30)
            except OSError:
                if time.monotonic() > end or self.process.poll() is not None:
                    raise FirefoxError(f'Firefox does not begin: {self.said.read_text(errors="replace")}') from None
                time.sleep(0.2)

    def hear(self):
        while True:
            head, colon, rest = self.input.partition(b':')
            if colon and len(rest) >= int(head):
                self.input = rest[int(head):]
                return json.loads(rest[:int(head)])
            more = self.socket.recv(1 << 16)
            if not more:
                raise FirefoxError('Firefox has gone')
            self.input += more

    def do(self, command, **parameters):
        self.last += 1
        message = json.dumps([0, self.last, command, parameters]).encode()
        self.socket.sendall(b'%d:%s' % (len(message), message))
        while True:
            kind, number, error, result = self.hear()
            if kind == 1 and number == self.last:
                if error:
                    raise FirefoxError(f"{command}: {error['message']}")
                return result

    def get(self, address):
        self.do('WebDriver:Navigate', url=address)

    def find_elements(self, by, value):
        found = self.do('WebDriver:FindElements', using=by, value=value)
        return [Element(self, it[KEY]) for it in found]

    def find_element(self, by, value):
        using, given = ('css selector', f'#{value}') if by == 'id' else (by, value)
        return Element(self, self.do('WebDriver:FindElement', using=using, value=given)['value'][KEY])

    def execute_script(self, script, *arguments):
        given = [{KEY: it.name} if isinstance(it, Element) else it for it in arguments]
        return self.do('WebDriver:ExecuteScript', script=script, args=given)['value']

    def save_screenshot(self, path):
        picture = self.do('WebDriver:TakeScreenshot', full=False)['value']
        pathlib.Path(path).write_bytes(base64.b64decode(picture))

    def get_log(self, _):
        lines = self.said.read_text(errors='replace').splitlines()
        return [{'level': 'SEVERE', 'message': line} for line in lines
                if ('JavaScript error' in line or 'console.error' in line) and '127.0.0.1' in line]

    def quit(self):
        atexit.unregister(self.quit)
        try:
            self.do('Marionette:Quit', flags=['eForceQuit'])
        except (FirefoxError, OSError):
            pass
        self.socket.close()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            pass
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()
        self.profile.cleanup()
