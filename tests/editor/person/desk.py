# SPDX-License-Identifier: MIT
"""desk - a person at a desk: a screen, a keyboard, a pointer, and ladder-editor.

What the person sees is found by its accessible name, what the person does is done with a
real pointer and real keys. A test is a function; report() runs it and speaks TAP. What it
needs is in screen.py; without that all is skipped.

The accessibility bus gives all that the toolkit knows in one answer (org.a11y.atspi.Cache):
one node after the other would take most of a test's time. The palette, which is most of the
tree and never changes, is looked into only for its tiles.
"""
import gettext
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import traceback
import warnings

from node import A11Y, EXTENTS, ROLES, WHOLE, Gone, Node
from outcome import BUILD, LADDER, ROOT, check, lines, new_file, trace  # noqa: F401
from screen import PATIENCE, Screen, dbus, lacking, sh, until

warnings.simplefilter('ignore')
EDITOR = os.environ.get('LADDER_EDITOR') or os.path.join(BUILD, 'ladder-editor')
WRAPPER = os.environ.get('WRAPPER', '').split()  # valgrind and the like
SLOWLY = max(1, PATIENCE / 60)  # a hand knows a slow machine

editors = []  # those that were begun
DOUBLE_CLICK = 0.4  # s, of the toolkit


def missing():
    """What is not here, as one text; '' if all is."""
    return ', '.join(lacking() + ([] if os.path.exists(EDITOR) else [EDITOR]))


class Editor:
    """ladder-editor, as a person uses it."""

    def __init__(self, screen, *files, before=None, **env):
        """@before: done in the process before the editor begins"""
        self.screen = screen
        self.log = os.path.join(screen.home, 'editor-%d.log' % time.monotonic_ns())
        # Critical messages of the toolkit are faults of ours; what reads memory that was freed reads rubbish.
        with open(self.log, 'w') as log:
            self.process = subprocess.Popen([*WRAPPER, EDITOR, *files], stdout=log, stderr=subprocess.STDOUT,
                                            preexec_fn=before, env={**os.environ, 'G_DEBUG': 'fatal-criticals',
                                                                     'MALLOC_PERTURB_': '165', **env})
        self.clicked = 0.0  # when the last click began
        self.scale = int(env.get('GDK_SCALE', 1))  # pixels of the screen for one of a widget
        editors.append(self)
        self.bus = screen.accessibility()
        self.palette = None
        self.name, self.root = until(self.application, 'the editor on the accessibility bus')
        self.window = until(self.windows, 'a window')[0]
        until(lambda: self.all('Find an element'), 'the palette')
        self.lines = {node.path for node in self.all(role='text')}

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
        """The editor, or below a WRAPPER that began another process."""
        with open('/proc/%d/stat' % pid) as stat:
            parent = int(stat.read().rsplit(')', 1)[1].split()[1])
        if self.process.pid not in (pid, parent):
            return False
        self.pid = pid
        return True

    def alive(self):
        if self.process.poll() is not None:
            raise AssertionError('the editor ended with %d: %s' % (self.process.returncode, self.logged()))

    # ---- asking ----

    def call(self, name, path, interface, method):
        return self.bus.call_blocking(name, path, A11Y + interface, method, '', ())

    def ask(self, questions):
        """Answers of (path, interface, method, signature, arguments…), all asked at once; None: it is gone."""
        answers, waiting = [None] * len(questions), []
        for index, (path, interface, method, *args) in enumerate(questions):
            message = dbus.lowlevel.MethodCallMessage(self.name, path, A11Y + interface, method)
            message.append(*args[1:], signature=args[0] if args else '')

            def done(answer, index=index):
                if isinstance(answer, dbus.lowlevel.MethodReturnMessage):  # else it went while we asked
                    answers[index] = answer.get_args_list()
            waiting.append(self.bus.send_message_with_reply(message, done, 60))
        for reply in waiting:
            reply.block()
        self.alive()
        return answers

    # ---- seeing ----

    def known(self):
        """All that the toolkit knows, seen or not: path -> node."""
        try:
            items = self.bus.call_blocking(self.name, '/org/a11y/atspi/cache', A11Y + 'Cache', 'GetItems', '', ())
        except dbus.exceptions.DBusException:
            self.alive()
            raise
        nodes = [Node(self, item) for item in items]
        return {node.path: node for node in nodes}

    def seen(self, nodes, top=None):
        """The paths below each node that are seen: path -> paths in their order. What is hidden has
        the place of the next that is seen, and one that nobody asked for is not known yet: so all
        are asked, but for what never hides a part of its own, and the palette unless it is @top."""
        family = {path: [] for path in nodes}
        for node in nodes.values():
            family.setdefault(node.parent, []).append(node)
        below, asked, paths = {}, [], [self.root] + ([top] if top else [])
        while paths:
            path = paths.pop()
            node, children = nodes.get(path), sorted(family.get(path, []), key=lambda child: child.place)
            if node and not node.children and path != self.root:
                continue
            below[path] = [child.path for child in children]
            if not node or node.role not in WHOLE or [child.place for child in children] != list(range(node.children)):
                asked.append(path)
            paths += [child for child in below[path] if child != self.palette]
        answers = self.ask([(path, 'Accessible', 'GetChildren') for path in asked])
        for path, answer in zip(asked, answers):
            below[path] = [child for _, child in answer[0]] if answer else []
        return below

    def waken(self, paths, known):
        """A widget comes into being on the bus by being asked for, and what is below it, too."""
        while paths:
            known |= paths
            answers = self.ask([(path, 'Accessible', 'GetChildren') for path in paths])
            paths = {child for answer in answers if answer for _, child in answer[0]} - known

    def walk(self, path=None):
        unknown, before = {self.root}, set()
        while unknown - before:
            nodes, before = self.known(), unknown
            below = self.seen(nodes, path)
            unknown = {child for paths in below.values() for child in paths if child not in nodes}
            self.waken(unknown, set(nodes))
        paths = [path] if path else below.get(self.root, [])
        while paths:
            level = [nodes[each] for each in paths if each in nodes]
            yield from level
            paths = []
            for node in level:
                if node.name == 'Elements' and node.role == 49:
                    self.palette = node.path
                if node.path != self.palette or node.path == path:
                    for child in below.get(node.path, []):
                        page = child in nodes and not nodes[child].widget
                        paths += below.get(child, []) if page else [child]

    def all(self, name=None, role=None, below=None):
        """All widgets whose name holds a text; of a role."""
        return [node for node in self.walk(below) if (role is None or node.role == ROLES[role]) and
                (name is None or name in node.name)]

    def find(self, name=None, role=None, seconds=PATIENCE):
        def look():
            found = self.all(name, role)
            return found[0] if found else None
        return until(look, '%s "%s"' % (role or 'widget', name), seconds)

    def tile(self, name):
        """A tile of the palette."""
        return until(lambda: self.all(name, 'push button', self.palette), 'tile "%s"' % name)[0]

    def sheet(self):
        return self.find('Sheet')

    def elements(self):
        """Those that are seen on sheets: not the wire or the empty cell that the cursor is on."""
        return [node for node in self.all('Rung ', 'table cell') if not re.search(r', row \d+, column \w+$', node.name)]

    def cells(self):
        """Their names."""
        return [node.name for node in self.elements()]

    def says(self, text):
        """Waits until a text stands somewhere in the window."""
        return self.find(text)

    def windows(self):
        """Those that the window manager knows: no tooltip, no popup. Nothing is found, too, when
        one goes away while it is looked for: then it is looked again."""
        known = [int(number, 16) for number in re.findall('0x[0-9a-f]+', sh('xprop', '-root', '_NET_CLIENT_LIST'))]
        looks = (sh('xdotool', 'search', '--onlyvisible', '--pid', str(self.pid)).split() for _ in range(3))
        seen = next(filter(None, looks), [])
        return [window for window in seen if int(window) in known]

    def place(self, node):
        """Where a widget of the main window is on the screen: x, y, width, height."""
        about = dict(re.findall(r'(Absolute upper-left X|Absolute upper-left Y|Width|Height): +(-?\d+)',
                                sh('xwininfo', '-id', self.window)))
        frame = self.call(self.name, self.root, 'Accessible', 'GetChildren')[0][1]
        _, _, width, height = self.ask([(frame, *EXTENTS)])[0][0]
        x = int(about['Absolute upper-left X']) + (int(about['Width']) - width * self.scale) // 2
        y = int(about['Absolute upper-left Y']) + (int(about['Height']) - height * self.scale) // 2
        left, top, width, height = (each * self.scale for each in self.at_rest(node))
        return x + left, y + top, width, height

    @staticmethod
    def at_rest(node):
        """Where it is once it has come there: what was just made still moves."""
        seen = []

        def look():
            seen.append(node.box())
            return len(seen) > 1 and seen[-1] == seen[-2] and seen[-1][2] > 0 and seen[-1]
        return until(look, '"%s" to be at rest' % node.name)

    def centre(self, node):
        x, y, width, height = self.place(node)
        return x + width // 2, y + height // 2

    def popped(self, node):
        """The middle of a widget in a popover: that is a window of its own, of just its size."""
        left, top, width, height = self.at_rest(node)
        nodes = self.known()
        windows = [re.findall(r'(?:upper-left [XY]|Width|Height): +(-?\d+)', sh('xwininfo', '-id', each))
                   for each in sh('xdotool', 'search', '--onlyvisible', '--class', 'ladder-editor').split()]
        while node.parent in nodes:
            node = nodes[node.parent]
            x0, y0, *size = node.box() if node.widget else (0, 0)
            for about in windows:
                x, y, _, _, *of_window = [int(number) for number in about]
                if size and of_window == size:
                    return x + left - x0 + width // 2, y + top - y0 + height // 2
        raise AssertionError('"%s" is in no popover' % node.name)

    def grid(self, rung_y, column):
        """A point of the sheet: so many px below its top, in the middle of a column of 98 px."""
        x, y, _, _ = self.place(self.sheet())
        return x + 61 + 98 * column + 49, y + rung_y

    def element(self, *parts):
        """The element of a rung whose name has all these parts; waits for it."""
        def look():
            found = [node for node in self.elements() if all(part in node.name for part in parts)]
            return found[0] if found else None
        return until(look, 'the element %s' % ', '.join(parts))

    def middle(self, node):
        """Where the contact or coil of an element is; its wire is 46 px below its top."""
        x, y, width, _ = self.place(node)
        return x + width // 2, y + 46

    def beside(self, node):
        """On the wire of an element: the cursor goes there, and nothing else happens."""
        x, y, _, _ = self.place(node)
        return x + 12, y + 46

    def wire_end(self, rung_y, bar, by=0):
        """The left end of a column, and so many px to its right."""
        x, y, _, _ = self.place(self.sheet())
        return x + 61 + 98 * bar + by, y + rung_y

    def shot(self, name):
        """A picture for a person to look at, if PICTURES names a folder."""
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], name + '.png'))

    # ---- doing ----

    def click(self, at, button=1, count=1, shift=False):
        x, y = at if isinstance(at, tuple) else self.centre(at)
        if count > 1:  # a click just before would be one of them
            time.sleep(max(0.0, self.clicked + 2 * DOUBLE_CLICK - time.monotonic()))
        self.clicked = time.monotonic()
        held = [['keydown', 'Shift_L'], ['keyup', 'Shift_L']] if shift else [[], []]
        sh('xdotool', 'mousemove', str(x), str(y), *held[0], 'click', '--repeat', str(count), '--delay', '60', str(button), *held[1])

    def into(self, name):
        """Clicks into a line or a text until it has the keys: what lies round it may still move."""
        until(lambda: self.find(name, 'text').has(12) or self.click(self.find(name, 'text')), 'the keys in "%s"' % name)

    def tab(self, name):
        """Clicks on the tab of exactly that name, below the sheets or in a panel."""
        self.click(until(lambda: [node for node in self.all(name, 'page tab') if node.name == name], 'the tab ' + name)[0])

    def drag(self, start, end, steps=10, key=None, look=None, ready=None):
        """@key: held down meanwhile; @look: name of a picture of the moment before it is let go;
        @ready: what is waited for before, if it is not this window's own that is dragged"""
        (x0, y0), (x1, y1) = [at if isinstance(at, tuple) else self.centre(at) for at in (start, end)]
        way = ['keydown', key] if key else []
        way += ['mousemove', str(x0), str(y0), 'mousedown', '1']
        for i in range(1, steps + 1):
            way += ['mousemove', str(x0 + (x1 - x0) * i // steps), str(y0 + (y1 - y0) * i // steps),
                    'sleep', str(0.03 * SLOWLY)]
        sh('xdotool', *way, 'sleep', str(0.15 * SLOWLY))
        if ready:
            # One that began late has seen no movement yet.
            until(lambda: sh('xdotool', 'mousemove', str(x1 + 1), str(y1), 'mousemove', str(x1), str(y1)) or ready(),
                  'what is dragged to be welcome')
        if look:
            self.shot(look)
        sh('xdotool', 'mouseup', '1', *(['keyup', key] if key else []))

    def keys(self, *keys):
        sh('xdotool', 'key', '--delay', '20', *keys)

    def type(self, text):
        """Types a text; what no key of the keyboard gives is pasted, as an input method would,
        into a line or a text: when it stands there."""
        if text.isascii():
            sh('xdotool', 'type', '--delay', '15', '--', text)
            return
        self.put_clipboard(text)
        self.keys('ctrl+v')
        until(lambda: any(text in node.text() for node in self.all(role='text')), 'what is pasted')

    def put_clipboard(self, text):
        """Of another program: that it took it is no sign yet that the screen knows."""
        subprocess.run(['xclip', '-selection', 'clipboard'], input=text, text=True, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(lambda: sh('timeout', '10', 'xclip', '-selection', 'clipboard', '-o') == text.strip().replace('\r\n', '\n'),
              'the text in the clipboard')

    def entry(self, text, enter=True):
        """Types into the line that opens at the cursor, and waits until it is gone."""
        self.type(text)
        if enter:
            self.keys('Return')
            self.gone()

    def asked(self):
        """The line that is open at the cursor."""
        return [node for node in self.all(role='text') if node.path not in self.lines]

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
        """Ctrl+S, and waits until the file is another."""
        before = open(path).read() if os.path.exists(path) else None
        self.keys('ctrl+s')

        def look():
            self.alive()
            return os.path.exists(path) and open(path).read() != before
        until(look, 'the file to be saved')
        return open(path).read()

    def logs(self, kind, text):
        """Waits until the log, which is shown, has a line of that kind with a text; gives all of it."""
        self.tab('Log')
        line = re.compile(r'^[0-9:]{8}\t%s\t.*%s' % (kind, re.escape(text)), re.MULTILINE)

        def look():
            return next((log for log in (node.text() for node in self.all('Log', 'text')) if line.search(log)), None)
        return until(look, 'the line "%s" of %s in the log' % (text, kind))

    def give_path(self, path, ask, title=''):
        """Types a path into the chooser of files that a key, or what is called, brings; waits until it has gone."""
        chooser = self.brought(ask, title)
        self.type_path(path)
        self.keys('Return')
        until(lambda: chooser not in self.windows(), 'the end of the chooser')

    def brought(self, ask, title=''):
        """The window of a title that a key, or what is called, brings: when it has the keys, which is after it is seen."""
        before = self.windows()
        ask() if callable(ask) else self.keys(ask)
        window = until(lambda: [each for each in self.windows() if each not in before and
                                title in sh('xdotool', 'getwindowname', each)], 'the window "%s"' % title)[0]
        until(lambda: sh('xdotool', 'getactivewindow') == window and self.focused(), 'the keys in it')
        return window

    def list_commands(self):
        """Opens the list of all commands."""
        window = self.brought('ctrl+k')
        until(lambda: self.all('About Rungboard'), 'all commands')
        return window

    def command(self, name):
        """Does a command that is found by its name in the list of all."""
        window = self.list_commands()
        self.type(name)
        until(lambda: not self.all('About Rungboard'), 'that command alone')
        self.keys('Return')
        until(lambda: window not in self.windows(), 'the end of the list')

    def type_path(self, path):
        """Over what stands in the chooser of files that has the keys; it has them before they are a path."""
        self.keys('ctrl+a')
        self.type(path)
        until(lambda: any(node.text() == path for node in self.all(role='text')), 'the path in the chooser')

    def front(self):
        """Brings its window before the others."""
        sh('xdotool', 'windowactivate', '--sync', self.window)

    def reply(self, button):
        """Presses a button of the dialog that is there, or comes."""
        path = self.find(role='dialog').path
        until(lambda: self.all(button, 'push button', path), 'the button "%s"' % button)[0].press()

    def answer(self, button):
        """The same, and waits until the dialog is gone and what was below it has the keys again."""
        self.reply(button)
        until(lambda: not self.all(role='dialog') and self.focused(), 'the dialog to be gone')

    def focused(self):
        """The widget that has the focus of the keyboard; None: none is known."""
        return next((node for node in self.walk() if node.states >> 12 & 1), None)

    def focus_on(self, name=None, role=None, but=None):
        """Waits until a widget of a name or role has the focus, another than @but; returns it."""
        def look():
            node = self.focused()
            return node and (name is None or name in node.name) and (
                role is None or node.role == ROLES[role]) and (but is None or node.path != but.path) and node
        return until(look, 'the focus on %s "%s"' % (role or 'widget', name))

    def choose(self, text):
        """Goes down to a text in the list that just opened, and takes it."""
        row = self.focus_on(role='list item')
        while not self.all(text, 'label', row.path):
            self.keys('Down')
            row = self.focus_on(role='list item', but=row)
        self.keys('Return')

    def to_sheet(self):
        until(lambda: self.sheet().has(12), 'the focus on the sheet')

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        editors.remove(self)

    def finish(self):
        """As a session ends: in good order, whatever is on the screen."""
        if self.process.poll() is None:
            os.kill(self.pid, signal.SIGTERM)
        editors.remove(self)
        status = self.process.wait(PATIENCE)
        assert status == 0, 'the editor ended with %d: %s' % (status, self.logged())

    def logged(self):
        """What it wrote for nobody to see: messages of the toolkit, of sanitizers."""
        with open(self.log) as log:
            return log.read()


class Chinese(Editor):
    """The same, where what is looked for is said in Chinese."""

    def __init__(self, screen, *files, **env):
        self.said = gettext.translation('rungboard', os.path.join(BUILD, 'locale'), ['zh_CN'])
        super().__init__(screen, *files, LANGUAGE='zh_CN', **env)

    def all(self, name=None, *more, **named):
        return super().all(name and self.said.gettext(name), *more, **named)


def report(tests):
    """Runs the tests one after another at one desk, as TAP; returns the exit status. Each has a home folder and
    editors of its own. A test may have a `size`, of its screen: then it has a desk of its own, and so has the
    test behind one that failed."""
    lacks = missing()
    if lacks:
        print('1..0 # SKIP needs ' + lacks)
        return 0
    done, failed = 0, False
    while done < len(tests):
        size = size_of(tests[done])
        same = next((i for i in range(done, len(tests)) if size_of(tests[i]) != size), len(tests))
        sys.stdout.flush()
        # A process each: the accessibility bus is that of the first screen it saw.
        child = os.fork()
        if child == 0:
            passed = 0
            try:
                passed = run_at_one_desk(done, tests[done:same], size)
            except Exception:
                traceback.print_exc()
            os._exit(passed)
        passed = max(0, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
        if passed < same - done:
            failed = True
            passed += 1  # that one has failed
        done += passed
    print('1..%d' % len(tests))
    return int(failed)


def size_of(test):
    return getattr(test, 'size', '1440x900x24')


def run_at_one_desk(done, tests, size):
    """Returns how many passed before the first that failed."""
    screen, passed = Screen(size), 0
    while passed < len(tests) and run(screen, done + passed + 1, tests[passed], passed > 0):
        passed += 1
    screen.close()
    sys.stdout.flush()
    return passed


def keep_log(editor, number):
    """Beside the pictures, if there is anything in it."""
    if os.environ.get('PICTURES') and os.path.getsize(editor.log):
        shutil.copy(editor.log, os.path.join(os.environ['PICTURES'], 'log-%d.txt' % number))


def keep_failure(number, test, error):
    """A few lines for who sees only the end of a long log: where in the script, and what did not come."""
    folder, script = os.path.join(BUILD, 'failed'), os.path.basename(sys.argv[0])
    ways = ['%s:%d %s' % (os.path.basename(step.filename), step.lineno, step.line)
            for step in traceback.extract_tb(error.__traceback__)]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, '%s-%d' % (script, number)), 'w') as file:
        file.write('\n'.join([test.__doc__, *ways[1:5], repr(error)[:600], '']))


def run(screen, number, test, used):
    """Runs one test; False if it failed. @used: another test was at this desk before."""
    begin = time.monotonic()
    try:
        if used:
            screen.tidy()
        test(screen)
        for editor in editors[:]:
            editor.finish()
            keep_log(editor, number)
        print('ok %d - %s # %.1f s' % (number, test.__doc__, time.monotonic() - begin), flush=True)
        return True
    except Exception as error:
        print('not ok %d - %s' % (number, test.__doc__))
        keep_failure(number, test, error)
        print('# ' + ''.join(traceback.format_exception(error)[-3:]).replace('\n', '\n# '))
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], 'failed-%d.png' % number))
        print('# ' + '\n# '.join(screen.told()))
    for editor in editors[:]:
        print('# ' + editor.logged().replace('\n', '\n# '))
        editor.kill()
    return False


def main(tests):
    sys.exit(report(tests))


if __name__ == '__main__':  # desk.py COMMAND...: runs a command at a desk of its own
    if missing():
        sys.exit('needs ' + missing())
    desk = Screen()
    status = subprocess.run(sys.argv[1:]).returncode
    desk.close()
    sys.exit(status)
