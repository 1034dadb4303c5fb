# SPDX-License-Identifier: MIT
"""desk - a person at a desk: a screen, a keyboard, a pointer, and ladder-editor.

What the person sees is found by its accessible name, what the person does is done with a
real pointer and real keys. A test is a function; report() runs it and speaks TAP. It needs
Xvfb, openbox, xdotool, xclip, AT-SPI with its Python binding; without them all is skipped.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import warnings

warnings.simplefilter('ignore')
ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..', '..'))
BUILD = os.path.join(ROOT, os.environ.get('BUILD', 'build'))
EDITOR = os.path.join(BUILD, 'ladder-editor')
LADDER = os.path.join(BUILD, 'ladder')
PATIENCE = 20  # seconds until what must come did not; no test waits for it in vain

Atspi = None
ended = []  # what is to be done when a test is over


def missing():
    """What is not here, as one text; '' if all is."""
    global Atspi
    lacks = [tool for tool in ('Xvfb', 'openbox', 'xdotool', 'xwininfo', 'xprop', 'xclip', 'import',
                               'dbus-daemon') if not shutil.which(tool)]
    if not os.path.exists(EDITOR):
        lacks.append(EDITOR)
    try:
        import gi
        gi.require_version('Atspi', '2.0')
        from gi.repository import Atspi as atspi
        Atspi = atspi
    except (ImportError, ValueError):
        lacks.append('python3-gi and gir1.2-atspi-2.0')
    return ', '.join(lacks)


def sh(*args, **more):
    return subprocess.run(args, capture_output=True, text=True, timeout=60, **more).stdout.strip()


def until(look, what, seconds=PATIENCE):
    """Waits until look() gives something, and gives that."""
    end = time.monotonic() + seconds
    while True:
        value = look()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError('it did not come: ' + what)
        time.sleep(0.02)


class Screen:
    """A private X screen with a window manager, a session bus, a home folder."""

    def __init__(self, size='1440x900x24'):
        self.home = tempfile.mkdtemp(prefix='rungboard-desk-')
        self.running = []
        os.environ.update(HOME=self.home, XDG_RUNTIME_DIR=self.home, LC_ALL='C.UTF-8', LANGUAGE='',
                          GDK_BACKEND='x11', GSK_RENDERER='cairo', GTK_A11Y='atspi',
                          GSETTINGS_BACKEND='memory', ADW_DISABLE_PORTAL='1', GTK_USE_PORTAL='0',
                          XDG_STATE_HOME=os.path.join(self.home, 'state'), NO_AT_BRIDGE='0')
        os.environ.pop('XDG_DATA_HOME', None)
        self.start_bus()
        read, write = os.pipe()
        self.start('Xvfb', '-displayfd', str(write), '-screen', '0', size, '-nolisten', 'tcp', '-noreset',
                   pass_fds=[write])
        os.close(write)
        number = b''
        while not number.endswith(b'\n'):
            number += os.read(read, 16)
        os.environ['DISPLAY'] = ':' + number.decode().strip()
        self.start('openbox', '--sm-disable')
        until(lambda: 'window id' in sh('xprop', '-root', '_NET_SUPPORTING_WM_CHECK'), 'the window manager')

    def start_bus(self):
        bus = subprocess.Popen(['dbus-daemon', '--session', '--nofork', '--print-address=1'],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.running.append(bus)
        os.environ['DBUS_SESSION_BUS_ADDRESS'] = bus.stdout.readline().strip()

    def start(self, *args, **more):
        self.running.append(subprocess.Popen(args, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more))

    def close(self):
        while self.running:
            process = self.running.pop()
            process.kill()
            process.wait()
        shutil.rmtree(self.home, ignore_errors=True)


class Editor:
    """ladder-editor, as a person uses it."""

    def __init__(self, screen, *files, **env):
        self.screen = screen
        self.log = os.path.join(screen.home, 'editor-%d.log' % time.monotonic_ns())
        # Warnings of the toolkit are faults of ours.
        self.process = subprocess.Popen([EDITOR, *files], stdout=open(self.log, 'w'), stderr=subprocess.STDOUT,
                                        env={**os.environ, 'G_DEBUG': 'fatal-criticals', **env})
        ended.append(self.kill)
        self.root = until(self.application, 'the editor on the accessibility bus')
        until(lambda: self.all('Find an element'), 'the window')
        self.window = until(self.windows, 'a window')[0]
        self.lines = {node.get_name() for node in self.all(role='text')}

    def application(self):
        if self.process.poll() is not None:
            raise AssertionError('the editor ended: ' + open(self.log).read())
        desktop = Atspi.get_desktop(0)
        for i in range(desktop.get_child_count()):
            child = desktop.get_child_at_index(i)
            if child and child.get_process_id() == self.process.pid and child.get_child_count() > 0:
                return child
        return None

    # ---- seeing ----

    def walk(self, node=None):
        node = node or self.root
        yield node
        for i in range(node.get_child_count()):
            child = node.get_child_at_index(i)
            if child:
                yield from self.walk(child)

    def all(self, name=None, role=None):
        found = []
        for node in self.walk():
            try:
                if (role is None or node.get_role_name() == role) and \
                        (name is None or name in (node.get_name() or '')):
                    found.append(node)
            except Exception:  # it went while we looked
                pass
        return found

    def find(self, name=None, role=None, seconds=PATIENCE):
        def look():
            found = self.all(name, role)
            return found[0] if found else None
        return until(look, '%s "%s"' % (role or 'widget', name), seconds)

    def sheet(self):
        return self.find('Sheet')

    def cells(self):
        """Names of the elements that are seen on sheets."""
        return [n.get_name() for n in self.all(role='table cell')]

    def windows(self):
        return sh('xdotool', 'search', '--onlyvisible', '--pid', str(self.process.pid)).split()

    def place(self, node):
        """Where a widget of the main window is on the screen: x, y, width, height."""
        about = dict(re.findall(r'(Absolute upper-left X|Absolute upper-left Y|Width|Height): +(-?\d+)',
                                sh('xwininfo', '-id', self.window)))
        frame = self.find(role='frame')
        outer = Atspi.Component.get_extents(frame, Atspi.CoordType.WINDOW)
        x = int(about['Absolute upper-left X']) + (int(about['Width']) - outer.width) // 2
        y = int(about['Absolute upper-left Y']) + (int(about['Height']) - outer.height) // 2
        at = Atspi.Component.get_extents(node, Atspi.CoordType.WINDOW)
        return x + at.x, y + at.y, at.width, at.height

    def centre(self, node):
        x, y, width, height = self.place(node)
        return x + width // 2, y + height // 2

    def grid(self, rung_y, column):
        """A point of the sheet: so many px below its top, in the middle of a column of 98 px."""
        x, y, _, _ = self.place(self.sheet())
        return x + 61 + 98 * column + 49, y + rung_y

    def shot(self, name):
        """A picture for a person to look at, if PICTURES names a folder."""
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], name + '.png'))

    # ---- doing ----

    def click(self, at, button=1, count=1):
        x, y = at if isinstance(at, tuple) else self.centre(at)
        sh('xdotool', 'mousemove', str(x), str(y), 'click', '--repeat', str(count), '--delay', '60', str(button))

    def drag(self, start, end, steps=10):
        (x0, y0), (x1, y1) = [at if isinstance(at, tuple) else self.centre(at) for at in (start, end)]
        sh('xdotool', 'mousemove', str(x0), str(y0), 'mousedown', '1')
        for i in range(1, steps + 1):
            sh('xdotool', 'mousemove', str(x0 + (x1 - x0) * i // steps), str(y0 + (y1 - y0) * i // steps))
            time.sleep(0.02)
        time.sleep(0.1)
        sh('xdotool', 'mouseup', '1')

    def keys(self, *keys):
        sh('xdotool', 'key', '--delay', '20', *keys)

    def type(self, text):
        """Types a text; what no key of the keyboard gives is pasted, as an input method would."""
        if text.isascii():
            sh('xdotool', 'type', '--delay', '15', text)
            return
        subprocess.run(['xclip', '-selection', 'clipboard'], input=text, text=True, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.keys('ctrl+v')

    def entry(self, text, enter=True):
        """Types into the line that opens at the cursor, and waits until it is gone."""
        self.type(text)
        if enter:
            self.keys('Return')
            self.gone()

    def asked(self):
        """The line that is open at the cursor."""
        return [node for node in self.all(role='text') if node.get_name() not in self.lines]

    def gone(self):
        until(lambda: not self.asked(), 'the entry to be gone')

    def opened(self):
        until(self.asked, 'an entry')

    def save(self, path):
        """Ctrl+S, and waits until the file is another."""
        before = open(path).read() if os.path.exists(path) else None
        self.keys('ctrl+s')
        until(lambda: os.path.exists(path) and open(path).read() != before, 'the file to be saved')
        return open(path).read()

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()


# ---- what came of it ----

def check(path):
    """ladder check must be content."""
    done = subprocess.run([LADDER, 'check', path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stderr


def trace(path, script):
    """What the saved program does."""
    with tempfile.NamedTemporaryFile('w', suffix='.script') as file:
        file.write(script)
        file.flush()
        done = subprocess.run([LADDER, 'trace', path, file.name], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def new_file(screen, text='RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n', name='new.rung'):
    path = os.path.join(screen.home, name)
    with open(path, 'w') as file:
        file.write(text)
    return path


def report(tests, size='1440x900x24'):
    """Runs the tests, each at a desk of its own, as TAP; returns the exit status."""
    lacks = missing()
    if lacks:
        print('1..0 # SKIP needs ' + lacks)
        return 0
    failed = 0
    for number, test in enumerate(tests, 1):
        # A process each: the accessibility bus is that of the first screen it saw.
        child = os.fork()
        if child == 0:
            os._exit(run(number, test, size))
        failed |= os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) != 0
    print('1..%d' % len(tests))
    return int(failed)


def run(number, test, size):
    begin = time.monotonic()
    screen = Screen(size)
    failed = 1
    try:
        test(screen)
        print('ok %d - %s # %.1f s' % (number, test.__doc__, time.monotonic() - begin))
        failed = 0
    except Exception as error:
        print('not ok %d - %s' % (number, test.__doc__))
        print('# ' + str(error).replace('\n', '\n# '))
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], 'failed-%d.png' % number))
    for end in ended:
        end()
    screen.close()
    sys.stdout.flush()
    return failed


def main(tests, **more):
    sys.exit(report(tests, **more))
