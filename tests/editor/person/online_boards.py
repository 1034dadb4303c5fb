#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online_boards - two windows with a board each, a screen reader, and a board at the end of a serial line.

The boards are ladderds of this machine, whose lines are simulated.
"""
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../online'))
from desk import BUILD, Editor, main, new_file, sh, until  # noqa: E402
from languages import Foreign  # noqa: E402
from online import SEAL, Board, connect, says, shown_log  # noqa: E402
from online_live import PUMP  # noqa: E402
from serial_line import Cable  # noqa: E402
from spoken import ROWS, nameless  # noqa: E402

MAP = 'BOARD "%s"\n%%IX0.0 sim\n%%QX0.0 sim\n'
MILL = PUMP.replace('"Pump"', '"Mill"')
BARN = PUMP.replace('"Pump"', '"Barn"').replace('30', '70')


def front(editor, name):
    """Brings the window of a project to the front; returns the path of its frame."""
    window = until(lambda: [each for each in editor.windows() if sh('xdotool', 'getwindowname', str(each)).startswith(name)], name)
    sh('xdotool', 'windowactivate', '--sync', str(window[0]))
    return until(lambda: [node for node in editor.all(role='frame') if node.name.startswith(name)], 'the frame of ' + name)[0].path


def cell(editor, frame, *parts):
    return until(lambda: [node for node in editor.all('Rung ', 'table cell', frame) if all(part in node.name for part in parts)],
                 ', '.join(parts))


def has(editor, frame, text):
    return bool([node for node in editor.all(text, 'label', frame)])


def two(screen):
    """two windows with a board each: values, a force, a download and the end of one leave the other alone"""
    boards = [Board(screen, name, program=text, board=MAP % name) for name, text in (('mill', MILL), ('barn', BARN))]
    paths = [new_file(screen, MILL, 'mill.rung'), new_file(screen, BARN, 'barn.rung')]
    for path, name in zip(paths, ('mill', 'barn')):
        with open(path[:-5] + '.io', 'w') as out:
            out.write(MAP % name)
    editor = Editor(screen, *paths)
    until(lambda: len(editor.windows()) == 2, 'two windows')
    frames = []
    for board, name in zip(boards, ('Mill', 'Barn')):
        frames.append(front(editor, name))
        until(lambda: any(node.has(12) for node in editor.all('Sheet', below=frames[-1])), 'the keys in the sheet')
        connect(editor, board.where)
        until(lambda: has(editor, frames[-1], name.lower() + ' · RUN'), name)
    mill, barn = frames
    cell(editor, mill, 'Rung 2, [ ]', '30 > 20, closed')
    cell(editor, barn, 'Rung 2, [ ]', '70 > 20, closed')
    boards[0].ask('force', 'Start=1')
    cell(editor, mill, 'Rung 1, COIL', ', on')
    cell(editor, barn, 'Rung 1, COIL', ', off')
    assert not [node for node in editor.all('1 force', 'push button', barn)], 'the force is of the other board'
    editor.shot('online-two')
    front(editor, 'Barn')
    editor.keys('ctrl+Home', 'ctrl+d')
    until(lambda: has(editor, barn, 'Changed here, not downloaded.'), 'the change')
    assert has(editor, mill, 'The board runs this program.')
    identity = boards[0].ask('status').split('program')[1].splitlines()[0]
    editor.keys('ctrl+shift+l')
    editor.find('Download to “barn”?', 'label')
    editor.keys('Return')
    until(lambda: has(editor, barn, 'The board runs this program.'), 'the download')
    cell(editor, barn, 'Rung 3, [ ]', '70 > 20, closed')
    assert boards[0].ask('status').split('program')[1].splitlines()[0] == identity
    assert has(editor, mill, 'mill · RUN') and has(editor, mill, 'The board runs this program.')
    front(editor, 'Mill')
    editor.command('Disconnect')
    until(lambda: not has(editor, mill, 'mill · RUN'), 'the end of one')
    boards[1].ask('set', 'Level=9')
    cell(editor, barn, 'Rung 3, [ ]', '9 > 20, open')
    assert has(editor, barn, 'barn · RUN')
    for board in boards:
        assert 'mode: RUN' in board.ask('status')
        board.stop()


def spoken_all(screen):
    """connecting, the bar and the state of the board have a name for each widget; a download is asked for and left by keys"""
    board = Board(screen, 'mill', program=MILL, board=MAP % 'mill')
    path = new_file(screen, MILL, 'mill.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(MAP % 'mill')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+shift+m')
    editor.find('Connect to a board')
    editor.focus_on('Board', 'text')
    assert not nameless(editor), nameless(editor)
    editor.type(board.where)
    editor.keys('Return')
    says(editor, 'mill · RUN')
    assert not nameless(editor), nameless(editor)
    editor.to_sheet()
    editor.keys('ctrl+d', 'ctrl+shift+l')
    editor.find('Download to “mill”?', 'label')
    until(lambda: [node for node in editor.all('Download', 'push button') if node.name == 'Download'], 'its button')
    assert not nameless(editor), nameless(editor)
    editor.keys('Escape')
    until(lambda: not editor.all('Download to “mill”?', 'label'), 'the end of the dialog')
    says(editor, 'Changed here, not downloaded.')
    editor.command('State of the board')
    says(editor, 'Missed scans')
    assert not nameless(editor), nameless(editor)
    board.stop()


SEAL_MAP = MAP % 'garage'


def exact(editor, name, role='push button', below=None):
    """The widget of exactly that name, in the language of the editor."""
    name = editor.said.gettext(name) if isinstance(editor, Foreign) else name
    return until(lambda: [node for node in editor.all(name, role, below) if node.name == name and node.box()[2] > 0], name)[0]


def click_in(editor, node):
    """Clicks at a widget of the dialog that has the keys."""
    about = dict(re.findall(r'(Absolute upper-left [XY]|Width|Height): +(-?\d+)', sh('xwininfo', '-id', sh('xdotool', 'getactivewindow'))))
    nodes, top = editor.known(), node
    while top.parent in nodes and top.parent != editor.root:
        top = nodes[top.parent]
    (left, up, width, height), (_, _, whole, high) = editor.at_rest(node), top.box()
    editor.clicked = 0.0
    sh('xdotool', 'mousemove', str(int(about['Absolute upper-left X']) + (int(about['Width']) - whole) // 2 + left + width // 2),
       str(int(about['Absolute upper-left Y']) + (int(about['Height']) - high) // 2 + up + height // 2), 'click', '1')


def closed(editor):
    """Esc leaves the dialog that has the keys."""
    until(lambda: len(editor.windows()) == 2, 'the dialog')
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1 and editor.focused(), 'the end of the dialog')


def choice(editor, node, name):
    """An entry of the context menu of an element, by the pointer."""
    editor.click(editor.middle(node), button=3)
    editor.click(editor.popped(until(lambda: [each for each in editor.all(name, 'menu item') if each.box()[2] > 0], name)[0]))


def by_mouse(screen):
    """the mode by the pointer alone: a board of the list, its state, Stop and Run, a force, a value, a download, the log"""
    board = Board(screen, 'garage', program=PUMP, board=SEAL_MAP)
    path = new_file(screen, PUMP.replace('500ms', '600ms'), 'pump.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(SEAL_MAP)
    editor = Editor(screen, path)
    editor.click(exact(editor, 'Online', None))
    editor.focus_on('Board', 'text')
    editor.type(board.where)
    click_in(editor, exact(editor, 'Connect'))
    says(editor, 'garage · RUN')
    says(editor, 'The board runs another program.')
    editor.says('Values of the board are not shown: ')
    editor.click(exact(editor, 'Disconnect'))
    until(lambda: not editor.all('garage · RUN', 'label'), 'the bar to go')
    editor.click(exact(editor, 'Online', None))
    editor.focus_on('Board', 'text')
    click_in(editor, until(lambda: [node for node in editor.all('garage/link') if node.role in ROWS and node.box()[2] > 0],
                           'the recent board')[0])
    says(editor, 'garage · RUN')
    editor.says('Values of the board are not shown: ')
    editor.click(exact(editor, 'Download…'))
    editor.find('Download to “garage”?', 'label')
    click_in(editor, exact(editor, 'Download'))
    says(editor, 'The board runs this program.')
    editor.element('Rung 2, [ ]', '30 > 20, closed')
    until(lambda: not editor.all('Values of the board are not shown', 'label'), 'the status bar to take it back')
    choice(editor, editor.element('Rung 1, COIL', ', off'), 'Force on')
    editor.element('Rung 1, COIL', ', on, forced')
    editor.find('1 force', 'push button')
    assert 'Motor' in board.ask('forces')
    editor.shot('online-mouse-force')
    editor.click(exact(editor, 'Stop'))
    editor.find('Stop the program on “garage”?', 'label')
    click_in(editor, exact(editor, 'Stop', below=editor.find(role='dialog').path))
    says(editor, 'garage · STOP')
    editor.click(exact(editor, 'Run'))
    click_in(editor, exact(editor, 'Run', below=editor.find(role='dialog').path))
    says(editor, 'garage · RUN')
    until(lambda: not editor.all('forced', 'table cell'), 'the start to release it')
    until(lambda: not editor.all('Motor is forced', 'label'), 'the hint to say so')
    editor.tab('Status chart')
    editor.click(exact(editor, 'Motor, Force', None))
    editor.element('Rung 1, COIL', ', off, forced')
    editor.shot('online-mouse-chart')
    editor.click(exact(editor, 'Motor, Force', None))
    until(lambda: 'Motor' not in board.ask('forces'), 'the end of the force')
    editor.into('Level, New value')
    editor.type('7')
    editor.keys('Return')
    editor.element('Rung 2, [ ]', '7 > 20, open')
    editor.tab('Timing chart')
    until(lambda: [node for node in editor.all('Motor') if node.box()[2] > 0], 'the outputs in the timing chart')
    editor.shot('online-mouse-timing')
    editor.click(editor.find('Each scan', 'list item'), count=2)
    until(lambda: [node for node in editor.all(' run') if 'every' in node.name], 'the runs of the board')
    editor.shot('online-mouse-tasks')
    editor.tab('Log')
    for kind in 'System', 'Compile', 'Operator':
        editor.click(exact(editor, kind, None))
    until(lambda: {line.split('\t')[1] for line in shown_log(editor).split('\n')} == {'communication'}, 'one kind of lines')
    editor.shot('online-mouse-log')
    board.stop()


LOOP = SEAL.replace('  Count : INT;', '  Go : BOOL;').replace('PROGRAM Main LD\n', """PROGRAM Main LD
RUNG Again
  | NO Go | JMP Again |
""")


def fault(screen):
    """a FAULT by the pointer alone: the bar says why and offers Reset, for a person who may order it"""
    board = Board(screen, 'garage', program=LOOP)
    path = new_file(screen, LOOP, 'loop.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(SEAL_MAP)
    editor = Editor(screen, path)
    editor.click(exact(editor, 'Online', None))
    editor.focus_on('Board', 'text')
    editor.type(board.where)
    click_in(editor, exact(editor, 'Connect'))
    says(editor, 'garage · RUN')
    board.ask('set', 'Go=1')
    says(editor, 'garage · FAULT')
    editor.says('instruction budget of the scan exceeded (a loop?), Main rung 1')
    assert not [node for node in editor.all(role='push button') if node.name in ('Run', 'Stop')], 'Run or Stop in FAULT'
    editor.shot('online-mouse-fault')
    editor.click(exact(editor, 'Reset'))
    editor.find('Reset the fault of “garage”?', 'label')
    editor.shot('online-mouse-reset')
    click_in(editor, exact(editor, 'Reset', below=editor.find(role='dialog').path))
    says(editor, 'garage · RUN')
    board.stop()


def told_in(screen, language, **env):
    """The texts of the bar, its dialogs, the state of the board and the log, none of them English."""
    board = Board(screen, 'garage', program=SEAL, board=SEAL_MAP)
    path = new_file(screen, SEAL.replace('Count : INT', 'Total : DINT'), 'seal.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(SEAL_MAP)
    editor = Foreign(screen, language, path, **env)
    names = set()

    def look(picture):
        names.update(editor.names())
        editor.shot('online-%s-%s' % (language, picture))

    editor.to_sheet()
    editor.click(exact(editor, 'Online', None))
    until(lambda: editor.all('Connect to a board'), 'the dialog')
    editor.focus_on(editor.said.gettext('Board'), 'text')
    look('connect')
    editor.type(board.where)
    editor.keys('Return')
    exact(editor, 'The board runs another program.', 'label')
    look('differs')
    for button, heading in (('Download…', 'Download to “%s”?'), ('Stop', 'Stop the program on “%s”?')):
        editor.click(exact(editor, button))
        editor.find(editor.said.gettext(heading) % 'garage', 'label')
        look(button.strip('…').lower())
        closed(editor)
    if editor.said.gettext('State of the board').isascii():  # keys type it
        editor.command(editor.said.gettext('State of the board'))
        exact(editor, 'Missed scans', 'label')
        look('device')
    editor.tab(editor.said.gettext('Log'))
    exact(editor, 'Communication', None)
    look('log')
    log = next(node.text() for node in editor.all('Log', 'text'))
    board.stop()
    exact(editor, 'Connect again')
    look('lost')
    left = editor.english(names)
    assert not left, 'still English: %s' % left
    kinds = [editor.said.gettext(kind) for kind in ('system', 'compile', 'operator', 'communication')]
    assert {line.split('\t')[1] for line in log.split('\n')} <= set(kinds), log


def german(screen):
    """the mode in German, dark, on a small screen"""
    told_in(screen, 'de', ADW_DEBUG_COLOR_SCHEME='prefer-dark')


def french(screen):
    """the mode in French"""
    told_in(screen, 'fr')


def chinese(screen):
    """the mode in Chinese, dark, on a large screen"""
    told_in(screen, 'zh_CN', ADW_DEBUG_COLOR_SCHEME='prefer-dark')


german.size, chinese.size = '1024x700x24', '3840x2160x24'


class SerialBoard(Board):
    """The same at the end of a cable."""

    def __init__(self, screen, cable, *args, **named):
        self.cable = cable
        super().__init__(screen, *args, **named)
        self.where = 'serial:%s,115200' % cable.desk

    def start(self):
        self.daemon = subprocess.Popen(
            [os.path.join(os.path.abspath(BUILD), 'ladderd'), 'board.rung', '--io', 'board.io', '--link', 'link', '--groups', 'group',
             '--slots', 'slots', '--serial', self.cable.board + ',115200'], cwd=self.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(self.listens, 'the board')

    def beside(self, *words):
        """Asks over the socket: the line has one session."""
        return subprocess.run([os.path.join(os.path.abspath(BUILD), 'ladder'), 'board', 'unix:%s/link' % self.folder, *words],
                              capture_output=True, text=True, check=True).stdout


SLOW = int(os.environ.get('SLOW', '11520'))  # bytes a second: 115,200 baud


def serial(screen):
    """a serial line: values, a force and a download come over it, slowly"""
    with Cable(speed=SLOW) as cable:
        board = SerialBoard(screen, cable, 'far', program=PUMP, board=MAP % 'far')
        path = new_file(screen, PUMP, 'pump.rung')
        with open(path[:-5] + '.io', 'w') as out:
            out.write(MAP % 'far')
        editor = Editor(screen, path)
        editor.to_sheet()
        connect(editor, board.where)
        says(editor, 'far · RUN')
        editor.element('Rung 2, [ ]', '30 > 20, closed')
        board.beside('set', 'Level=7')
        editor.element('Rung 2, [ ]', '7 > 20, open')
        until(lambda: not editor.all(' s late', 'label'), 'values that are not late')
        editor.shot('online-serial')
        editor.to_sheet()
        editor.click(editor.beside(editor.element('Rung 1, COIL', ', off')))
        editor.keys('ctrl+shift+f')
        editor.element('Rung 1, COIL', ', off, forced')
        editor.keys('ctrl+shift+f')
        until(lambda: not editor.all('forced', 'table cell'), 'the force to end')
        editor.keys('ctrl+d')
        says(editor, 'Changed here, not downloaded.')
        editor.keys('ctrl+shift+l')
        editor.find('Download to “far”?', 'label')
        editor.keys('Return')
        says(editor, 'The board runs this program.')
        editor.element('Rung 3, [ ]', '7 > 20, open')
        board.stop()


def handed(screen):
    """two windows and one serial line: the second is told that it is in use, and has it once the first lets go"""
    with Cable() as cable:
        board = SerialBoard(screen, cable, 'far', program=PUMP, board=MAP % 'far')
        paths = [new_file(screen, text, name) for text, name in ((PUMP, 'pump.rung'), (BARN, 'barn.rung'))]
        editor = Editor(screen, *paths)
        until(lambda: len(editor.windows()) == 2, 'two windows')
        frames = {}
        for name in 'Pump', 'Barn':
            frames[name] = front(editor, name)
            until(lambda: any(node.has(12) for node in editor.all('Sheet', below=frames[name])), 'the keys in the sheet')
            connect(editor, board.where)
            until(lambda: has(editor, frames[name], 'far · RUN' if name == 'Pump' else 'another program or window uses this line'), name)
        editor.shot('online-serial-used')
        cell(editor, frames['Pump'], 'Rung 2, [ ]', '30 > 20, closed')
        front(editor, 'Pump')
        editor.command('Disconnect')
        until(lambda: not has(editor, frames['Pump'], 'far · RUN'), 'the first window to let go')
        front(editor, 'Barn')
        editor.command('Connect again')
        until(lambda: has(editor, frames['Barn'], 'far · RUN'), 'the second window to have it')
        until(lambda: has(editor, frames['Barn'], 'The board runs another program.'), 'what runs there')
        board.stop()


if __name__ == '__main__':
    main([two, spoken_all, by_mouse, fault, *([german, french, chinese] if os.path.isdir(os.path.join(BUILD, 'locale')) else []), serial, handed])
