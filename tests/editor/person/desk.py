# SPDX-License-Identifier: MIT
"""desk - uses ladder-editor as a person does, with a real pointer and real keys; finder.py finds the widgets.

A test is a function that gets a Screen; main() of report.py runs the tests of a script. All tests are skipped
without the programs of screen.py.
"""
import gettext
import os
import re
import signal
import subprocess
import sys
import time

import report
from finder import Finder
from node import A11Y, EXTENTS, ROLES, WHOLE, Gone, Node  # noqa: F401
from outcome import BUILD, LADDER, ROOT, check, lines, new_file, trace  # noqa: F401
from screen import PATIENCE, Focus, Screen, dbus, lacking, sh, until, urge

EDITOR = os.environ.get('LADDER_EDITOR') or os.path.join(BUILD, 'ladder-editor')
WRAPPER = os.environ.get('WRAPPER', '').split()  # valgrind and the like
WALK = os.path.join(os.path.abspath(BUILD), 'tests/editor/person/walk.so')
SLOWLY = max(1, PATIENCE / 60)  # typing waits longer on a slow machine

editors = []  # the editors that were started
DOUBLE_CLICK = 0.4  # s; of the toolkit


def missing():
    """What is not installed, as one text; '' if nothing is missing."""
    return ', '.join(lacking() + ([] if os.path.exists(EDITOR) else [EDITOR]))


def main(tests):
    """Runs all tests of a script, or some, and exits with the status."""
    sys.exit(report.report(report.chosen(tests), missing(), editors))


class Editor(Finder):
    """ladder-editor, as a person uses it."""

    def __init__(self, screen, *files, before=None, **env):
        """@before: called in the child process before the editor starts."""
        self.screen = screen
        self.log = os.path.join(screen.home, 'editor-%d.log' % time.monotonic_ns())
        # Critical messages of the toolkit are faults of the editor; memory that was freed holds rubbish.
        self.quick = os.path.exists(WALK) and not WRAPPER
        if self.quick:
            env['LD_PRELOAD'] = WALK
        with open(self.log, 'w') as log:
            self.process = subprocess.Popen([*WRAPPER, EDITOR, *files], stdout=log, stderr=subprocess.STDOUT,
                                            preexec_fn=before, env={**os.environ, 'G_DEBUG': 'fatal-criticals',
                                                                     'MALLOC_PERTURB_': '165', **env})
        self.clicked = 0.0  # when the last click began
        self.clicked_at = None  # where
        self.scale = int(env.get('GDK_SCALE', 1))  # pixels of the screen for one of a widget
        editors.append(self)
        self.bus = screen.accessibility()
        self.palette = None
        self.focus = None
        self.name, self.root = until(self.application, 'the editor on the accessibility bus')
        self.window = until(self.windows, 'a window')[0]
        def look():
            seen = list(self.walk())
            return any(self.fits(node, self.shown_as('Project'), None) for node in seen) and seen
        self.lines = {node.path for node in until(look, 'the project') if node.role == ROLES['text']}

    def application(self):
        self.alive()
        for name, path in self.call('org.a11y.atspi.Registry', '/org/a11y/atspi/accessible/root',
                                    'Accessible', 'GetChildren'):
            try:
                pid = self.bus.call_blocking('org.freedesktop.DBus', '/', 'org.freedesktop.DBus',
                                             'GetConnectionUnixProcessID', 's', (name,))
                if self.is_ours(pid) and self.call(name, path, 'Accessible', 'GetChildren'):
                    return name, path
            except (dbus.exceptions.DBusException, FileNotFoundError):
                pass  # an editor that just ended
        return None

    def is_ours(self, pid):
        """Is it the editor, or a child of a WRAPPER?"""
        with open('/proc/%d/stat' % pid) as stat:
            parent = int(stat.read().rsplit(')', 1)[1].split()[1])
        if self.process.pid not in (pid, parent):
            return False
        self.pid = pid
        return True

    def alive(self):
        if self.process.poll() is not None:
            raise AssertionError('the editor ended with %d: %s' % (self.process.returncode, self.logged()))

    # ---- doing ----

    def click(self, at, button=1, count=1, shift=False):
        x, y = at if isinstance(at, tuple) else self.centre(at)
        before, self.clicked_at = self.clicked_at, (x, y)
        if count > 1 or (before and abs(x - before[0]) + abs(y - before[1]) < 20):
            # A click right before it would make a double click of both.
            time.sleep(max(0.0, self.clicked + 2 * DOUBLE_CLICK - time.monotonic()))
        self.clicked = time.monotonic()
        held = [['keydown', 'Shift_L'], ['keyup', 'Shift_L']] if shift else [[], []]
        sh('xdotool', 'mousemove', str(x), str(y), *held[0], 'click', '--repeat', str(count), '--delay', '60', str(button), *held[1])

    def into(self, name):
        """Clicks into a line or text until it has the focus: the widgets around it may still move."""
        urge(lambda: self.find(name, 'text').has(12), lambda: self.click(self.find(name, 'text')), 'the keys in "%s"' % name)

    def tab(self, name):
        """Clicks the tab of exactly that name, below the sheets or in a panel, until it is in front: the row of tabs may
        still move when a mode has just begun."""
        def tabs():
            return [node for node in self.all(name, 'page tab') if node.name == name]
        self.click(until(tabs, 'the tab ' + name)[0])
        urge(lambda: any(node.states >> 23 & 1 for node in tabs()), lambda: self.click(tabs()[0]), 'the tab %s in front' % name,
             wait=5)

    def drag(self, start, end, steps=10, key=None, look=None, ready=None):
        """@key: held down meanwhile; @look: name of a picture taken before the release; @ready: what to wait for
        before the release, for a drag from another window."""
        (x0, y0), (x1, y1) = [at if isinstance(at, tuple) else self.centre(at) for at in (start, end)]
        way = ['keydown', key] if key else []
        way += ['mousemove', str(x0), str(y0), 'mousedown', '1']
        for i in range(1, steps + 1):
            way += ['mousemove', str(x0 + (x1 - x0) * i // steps), str(y0 + (y1 - y0) * i // steps),
                    'sleep', str(0.03 * SLOWLY)]
        sh('xdotool', *way, 'sleep', str(0.15 * SLOWLY))
        if ready:
            # A drag that began late has missed all movement so far.
            until(lambda: sh('xdotool', 'mousemove', str(x1 + 1), str(y1), 'mousemove', str(x1), str(y1)) or ready(),
                  'what is dragged to be welcome')
        if look:
            self.shot(look)
        sh('xdotool', 'mouseup', '1', *(['keyup', key] if key else []))

    def has_keys(self):
        """Does a window get the keys? When one has closed, the window manager has them for a moment."""
        self.focus = self.focus or Focus()
        return self.process.poll() is not None or self.focus.program() not in (0, self.screen.manager)

    def keys(self, *keys):
        if not self.has_keys():
            until(self.has_keys, 'a window for the keys')
        sh('xdotool', 'key', '--delay', '20', *keys)

    def type(self, text):
        """Types a text. Characters without a key are pasted into the line or text, as an input method would; waits
        until they are there."""
        if not self.has_keys():
            until(self.has_keys, 'a window for the keys')
        if text.isascii():
            sh('xdotool', 'type', '--delay', '15', '--', text)
            return
        self.put_clipboard(text)
        self.keys('ctrl+v')
        until(lambda: any(text in node.text() for node in self.all(role='text')), 'what is pasted')

    def put_clipboard(self, text):
        """Sets the clipboard from another program. Its exit does not mean that the X server knows yet."""
        subprocess.run(['xclip', '-selection', 'clipboard'], input=text, text=True, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(lambda: sh('timeout', '10', 'xclip', '-selection', 'clipboard', '-o') == text.strip().replace('\r\n', '\n'),
              'the text in the clipboard')

    def entry(self, text, enter=True):
        """Types into the entry that opens at the cursor, and waits until it closes."""
        self.type(text)
        if enter:
            self.keys('Return')
            self.gone()

    def asked(self):
        """The open entry at the cursor; not a cell of the table above the sheet, nor the log."""
        names, logs = [[said(name) for name in some for said in (str, getattr(self, 'said', gettext).gettext)]
                       for some in (('Pins', 'Variables'), ('Log',))]
        seen = list(self.walk())
        parents = {node.path: node.parent for node in seen}
        tables = {node.path for node in seen if node.name in names}

        def in_table(path):
            while path in parents:
                path = parents[path]
                if path in tables:
                    return True
            return False
        return [node for node in seen if node.role == ROLES['text'] and node.path not in self.lines and
                node.name not in logs and not in_table(node.path)]

    def candidate(self, *parts):
        """The row below the entry whose name has all these parts; waits for it."""
        def look():
            found = [node for node in self.all(parts[0], 'list item') if all(part in node.name for part in parts)]
            return found[0] if found else None
        return until(look, 'the candidate %s' % ', '.join(parts))

    def gone(self):
        until(lambda: not self.asked(), 'the entry to be gone')

    def opened(self):
        until(self.asked, 'an entry')

    def save(self, path):
        """Presses Ctrl+S and waits until the file has changed."""
        before = open(path).read() if os.path.exists(path) else None
        self.keys('ctrl+s')

        def look():
            self.alive()
            return os.path.exists(path) and open(path).read() != before
        until(look, 'the file to be saved')
        return open(path).read()

    def logs(self, kind, text):
        """Waits until the log, which is shown, has a line of that kind with the text; returns all its lines."""
        self.tab('Log')
        line = re.compile(r'^[0-9:]{8}\t%s\t.*%s' % (kind, re.escape(text)), re.MULTILINE)

        def look():
            return next((log for log in (node.text() for node in self.all('Log', 'text')) if line.search(log)), None)
        return until(look, 'the line "%s" of %s in the log' % (text, kind))

    def give_path(self, path, ask, title=''):
        """Opens the file chooser by a key or a call, types the path, and waits until the chooser closes."""
        chooser = self.brought(ask, title)
        self.type_path(path)
        self.keys('Return')
        until(lambda: chooser not in self.windows(), 'the end of the chooser')

    def brought(self, ask, title=''):
        """Opens a window by a key or a call and waits until it has the focus, which is later than it is visible.
        @title: needed where a dialog may come up meanwhile that asks first; it has the focus for a moment, too."""
        before = self.windows()
        ask() if callable(ask) else self.keys(ask)

        def look():
            window = sh('xdotool', 'getactivewindow')
            return window in self.windows() and window not in before and \
                title in sh('xdotool', 'getwindowname', window) and self.focused() and window
        return until(look, 'the window "%s" with the keys in it' % title)

    def list_commands(self):
        """Opens the list of all commands."""
        window = self.brought('ctrl+k')
        self.find('About Rungboard', 'list item')
        return window

    def command(self, name):
        """Runs a command, found by its name in the list of all."""
        window = self.list_commands()
        other = self.find('About Rungboard', 'list item')
        self.type(name)
        until(lambda: other.path not in self.shown(other.parent), 'that command alone')
        self.keys('Return')
        until(lambda: window not in self.windows(), 'the end of the list')

    def type_path(self, path):
        """Types a path into the active file chooser, and waits until its line has all of it. The first / opens the line
        of a chooser without one; where the / is lost, the chooser takes the rest for a search: then types it again."""
        def there():
            return any(node.text() == path and node.has(12) for node in self.all(role='text'))
        for patience in (PATIENCE / 4, PATIENCE):
            self.keys('ctrl+a')
            self.type(path)
            try:
                return until(there, 'the path in the chooser', patience)
            except AssertionError:
                self.alive()
                if patience == PATIENCE:
                    raise

    def front(self):
        """Brings its window to the front."""
        sh('xdotool', 'windowactivate', '--sync', self.window)

    def reply(self, button):
        """Presses a button of the open or coming dialog."""
        path = self.find(role='dialog').path
        until(lambda: self.all(button, 'push button', path), 'the button "%s"' % button)[0].press()

    def answer(self, button):
        """The same, then waits until the dialog closed and the window has the focus again."""
        self.reply(button)
        until(lambda: not self.all(role='dialog') and self.focused(), 'the dialog to be gone')

    def focused(self):
        """The widget with the keyboard focus; None: unknown."""
        return next((node for node in self.walk() if node.states >> 12 & 1), None)

    def focus_on(self, name=None, role=None, but=None):
        """Waits until a widget of a name or role other than @but has the focus; returns it."""
        def look():
            node = self.focused()
            return node and (name is None or name in node.name) and (
                role is None or node.role == ROLES[role]) and (but is None or node.path != but.path) and node
        return until(look, 'the focus on %s "%s"' % (role or 'widget', name))

    def choose(self, text):
        """Moves down to a text in the list that just opened, and takes it."""
        row = self.focus_on(role='list item')
        while not self.all(text, 'label', row.path):
            self.keys('Down')
            row = self.focus_on(role='list item', but=row)
        self.keys('Return')

    def step_to(self, look, key, what):
        """Moves the focus by a key until look() holds. Each time it waits until the focus has moved: with one key too
        many it would go past."""
        def moved(before):
            now = self.focused()
            return now and (not before or now.path != before.path)

        def step():
            before = self.focused()
            self.keys(key)
            try:
                until(lambda: look() or moved(before), 'the focus to move', 5)
            except AssertionError:
                self.alive()
        urge(look, step, what, 0)

    def to_sheet(self):
        until(lambda: self.sheet().has(12), 'the focus on the sheet')

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        editors.remove(self)

    def finish(self):
        """Ends the editor as a session does, whatever is on the screen."""
        if self.process.poll() is None:
            os.kill(self.pid, signal.SIGTERM)
        editors.remove(self)
        status = self.process.wait(PATIENCE)
        assert status == 0, 'the editor ended with %d: %s' % (status, self.logged())

    def logged(self):
        """Messages of the toolkit and of sanitizers."""
        with open(self.log) as log:
            return log.read()


class Chinese(Editor):
    """The same, with the texts to look for in Chinese."""

    def __init__(self, screen, *files, **env):
        self.said = gettext.translation('rungboard', os.path.join(BUILD, 'locale'), ['zh_CN'])
        super().__init__(screen, *files, LANGUAGE='zh_CN', **env)

    def shown_as(self, text):
        return self.said.gettext(text)


if __name__ == '__main__':  # desk.py COMMAND...: runs a command at a desk of its own
    if missing():
        sys.exit('needs ' + missing())
    desk = Screen()
    status = subprocess.run(sys.argv[1:]).returncode
    desk.close()
    sys.exit(status)
