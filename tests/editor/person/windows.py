#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""windows - rungs are copied between windows, and to and from text editors, as text."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402

SOURCE = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Self-holding"
  | NO Start     | NC Stop | COIL Motor |
  | NO Motor ^   |
END_PROGRAM
'''
TARGET = SOURCE[:SOURCE.index('RUNG "')] + 'RUNG\nEND_PROGRAM\n'


USES = '''RUNGBOARD 1

VAR
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL; (* it runs long *)
END_VAR

PROGRAM Main LD
VAR
  D1 : TON;
END_VAR
RUNG
  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |
RUNG
  | NO %IX0.0 | COIL Motor |
END_PROGRAM
'''
OTHER = '''RUNGBOARD 1

VAR
  Fan AT %QX0.1 : BOOL;
END_VAR

PROGRAM Second LD
RUNG
  | NO %IX0.0 | COIL %QX0.0 |
RUNG
END_PROGRAM
'''


PANEL = 230  # px; width of the tree
SHEETS = ('Main', 'Other', 'Second', 'Symbols')


def clipboard():
    return sh('timeout', '10', 'xclip', '-selection', 'clipboard', '-o')


def other_window(screen):
    """a rung copied in one window is pasted in another"""
    from_path, path = new_file(screen, SOURCE, 'from.rung'), new_file(screen, TARGET, 'to.rung')
    one = Editor(screen, from_path)
    one.to_sheet()
    one.keys('ctrl+a', 'ctrl+c')
    assert 'RUNG "Self-holding"' in until(lambda: clipboard() or None, 'text on the clipboard')
    two = Editor(screen, path)
    two.front()
    two.to_sheet()
    two.keys('ctrl+v')
    until(lambda: len(two.cells()) == 4, 'the elements')
    two.shot('windows-pasted')
    text = two.save(path)
    assert text.count('Self-holding') == 1, text
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\nStop=1\n') == ['Motor=1', 'Motor=1', 'Motor=0']
    one.front()
    one.keys('ctrl+z')
    assert open(from_path).read() == SOURCE


def declared(screen):
    """a pasted rung declares its variables in the project that lacks them; one undo removes both"""
    path = new_file(screen, OTHER, 'second.rung')
    one = Editor(screen, new_file(screen, USES, 'first.rung'))
    one.to_sheet()
    one.keys('ctrl+a', 'ctrl+c')
    until(lambda: 'D1 : TON;' in clipboard(), 'declarations on the clipboard')
    two = Editor(screen, path)
    two.front()
    two.to_sheet()
    two.keys('ctrl+End', 'ctrl+v')
    until(lambda: len(two.cells()) == 5, 'the elements')
    # %QX0.1 is Fan here.
    two.says('3 names were declared; Lamp has no address: %QX0.1 is Fan here')
    two.shot('windows-declared')
    text = two.save(path)
    check(path)
    assert '  Lamp  : BOOL; (* it runs long *)\n' in text, text
    assert lines(path, '@print Lamp\n%IX0.0=1\n+4000\n+2000\n') == ['Lamp=0', 'Lamp=0', 'Lamp=1'], text
    two.keys('ctrl+z')
    until(lambda: len(two.cells()) == 2, 'the rung to be gone')
    assert two.save(path) == OTHER
    two.keys('ctrl+y')
    until(lambda: len(two.cells()) == 5, 'the elements again')
    assert two.save(path) == text
    # All are declared now: only a rung is added, though the clipboard has the declarations.
    two.keys('ctrl+End', 'ctrl+a', 'ctrl+c', 'ctrl+v')
    until(lambda: len(two.cells()) == 8, 'the elements twice')
    again = two.save(path)
    rung = text[text.index('  | NO Motor'):text.index('END_PROGRAM')]
    assert again == text.replace('END_PROGRAM', 'RUNG\n' + rung + 'END_PROGRAM'), again


CHART = '''RUNGBOARD 1

TYPE
  Batch : STRUCT
    Size : INT;
  END_STRUCT;
END_TYPE

VAR
  Start AT %IX0.0 : BOOL;
  Pump  AT %QX0.1 : BOOL; (* it runs long *)
  This  : Batch;
END_VAR

PROGRAM Main SFC
VAR
  Level : INT := 7;
END_VAR
  INITIAL_STEP Idle:
  END_STEP
  STEP Fill:
    Pump(N);
  END_STEP
  TRANSITION FROM Idle TO Fill := Start AND Level > 5 AND This.Size > 0; END_TRANSITION
  TRANSITION FROM Fill TO Idle := NOT Start; END_TRANSITION
END_PROGRAM
'''
EMPTY = '''RUNGBOARD 1

VAR
  Fan AT %QX0.1 : BOOL;
END_VAR

PROGRAM Second SFC
  INITIAL_STEP Wait:
  END_STEP
END_PROGRAM
'''


def charts(screen):
    """the same for a chart; a variable of an unknown type stays undeclared; one undo"""
    path = new_file(screen, EMPTY, 'second.rung')
    one = Editor(screen, new_file(screen, CHART, 'first.rung'))
    one.find('Step Idle, initial', 'table cell')
    one.keys('ctrl+a', 'ctrl+c')
    until(lambda: 'Level : INT := 7;' in clipboard(), 'declarations on the clipboard')
    two = Editor(screen, path)
    two.front()
    two.find('Step Wait, initial', 'table cell')
    two.keys('ctrl+v')
    two.find('Step Fill', 'table cell')
    two.says('3 names were declared; Pump has no address: %QX0.1 is Fan here · the pasted part stands beside the chart')
    two.shot('windows-chart')
    text = two.save(path)
    assert 'Pump' in text and '(* it runs long *)' in text and 'Level : INT := 7;' in text, text
    assert 'Start AT %IX0.0 : BOOL;' in text and 'This' not in text[:text.index('STEP')], text
    two.keys('ctrl+z')
    until(lambda: not two.all('Step Fill', 'table cell'), 'the steps to be gone')
    assert two.save(path) == EMPTY


def from_text(screen):
    """a rung typed in a text editor is pasted"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.put_clipboard('RUNG\n  | NO Start | COIL Motor |\n')
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 2, 'the elements')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']
    saved = open(path).read()
    for text, why in ('this is no rung', 'The clipboard, line 1: “this” is not a known word'), \
            ('RUNG\n  | NO Start | COIL Motor |\nRUNG\n  | BADWORD Start |\n', 'line 4: "BADWORD" is not a known word'), \
            ('RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NO Start\nEND_PROGRAM\n', 'The clipboard, line 4: '):
        editor.put_clipboard(text)
        editor.keys('ctrl+v')
        editor.says(why)
        assert len(editor.cells()) == 2, 'what is no rung was pasted'
    editor.put_clipboard('| NO Stop | COIL %QX0.1 |\n')
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 4, 'the rung without its word')
    editor.put_clipboard(USES)
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 9, 'the rungs of the file')
    editor.says('2 names were declared')
    text = editor.save(path)
    check(path)
    assert text.startswith(saved[:saved.index('  Motor')]) and '  D1 : TON;\n' in text, text
    assert lines(path, '@print Motor\nStart=0\n%IX0.0=1\n')[-1] == 'Motor=1', text


def put_bytes(data):
    """Sets the clipboard to bytes declared as text; waits until they are there."""
    kind = ['-selection', 'clipboard', '-t', 'text/plain;charset=utf-8']
    subprocess.run(['xclip', *kind], input=data, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def begins():
        with subprocess.Popen(['timeout', '10', 'xclip', *kind, '-o'], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL) as given:
            return given.stdout.read(40)
    until(lambda: begins() == data[:40], 'the bytes on the clipboard')


def hostile(screen):
    """bytes that are no text are refused, and nothing changes"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    rung = b'RUNG\n  | NO Start | COIL Motor |\n'
    for text, why in (rung + b'\0' + rung, 'not valid UTF-8 text'), (b'this', 'The clipboard, line 1: “this” is not a known word'), \
            (rung.replace(b'Start', b'St\xffrt'), 'not valid UTF-8 text'), (b'this', 'The clipboard, line 1: “this” is not a known word'), \
            (b' ' * (65 << 20), 'file is too large'):
        put_bytes(text)
        editor.keys('ctrl+v')
        editor.says(why)
        assert editor.cells() == [], 'what is no text was pasted'
    editor.put_clipboard(rung.decode())
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 2, 'the elements')


def many(screen):
    """thousands of rungs are pasted; more than a program can hold are refused with a message"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    rung = 'RUNG\n  | NO Start | COIL Motor |\n'
    editor.put_clipboard(rung * 50001)
    editor.keys('ctrl+v')
    editor.says('too many rungs (at most 50000)')
    assert open(path).read() == TARGET
    editor.put_clipboard(rung * 3000)
    editor.keys('ctrl+v')
    until(lambda: editor.all('3000 rungs', 'label'), 'the rungs in the tree')
    assert editor.save(path).count(rung) == 3000
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def a_tab(screen):
    """a tab stays in the window of its project: dragged anywhere it does not leave its bar"""
    more = SOURCE + '\nPROGRAM Second LD\nRUNG\n  | NO Stop | COIL %QX0.1 |\nEND_PROGRAM\n'
    paths = new_file(screen, more, 'one.rung'), new_file(screen, more.replace('Main', 'Other'), 'two.rung')
    editor = Editor(screen, *paths)
    one, two = until(lambda: len(editor.windows()) == 2 and sorted(editor.windows(), key=int), 'two windows')
    for window, x, y in (one, 0, 0), (two, 300, 720):
        sh('xdotool', 'windowsize', '--sync', window, '1024', '700', 'windowmove', '--sync', window, str(x), str(y))

    def tabs(name):
        """The tabs of that program's window, from left to right: right of the tree, and of a tooltip's corner."""
        for frame in editor.all(role='frame'):
            named = [(node.box()[0], node) for node in editor.all(role='label', below=frame.path) if node.name in SHEETS]
            if name in [node.name for _, node in named]:
                return [node for left, node in sorted(named, key=lambda each: each[0]) if left > PANEL]
        return []

    def order(name):
        return [node.name for node in tabs(name)]

    def stay():
        until(lambda: (order('Main'), order('Other')) == (['Main', 'Second', 'Symbols'], ['Other', 'Second', 'Symbols']),
              'the tabs where they were')
    stay()
    x, y = editor.centre(tabs('Main')[1])

    def let_go(below, last):
        """Drags straight down; the tab is in its bar meanwhile."""
        way = [step for by in range(0, below + 1, below // 10) for step in
               ('mousemove', str(x), str(y + by), *(() if by else ('mousedown', '1')), 'sleep', '0.03')]
        sh('xdotool', *way, 'sleep', '0.2')
        assert order('Main') == ['Main', 'Second', 'Symbols'], order('Main')
        editor.shot('windows-tab-%d' % below)
        sh('xdotool', *last)
        stay()
    let_go(720, ['mouseup', '1'])
    let_go(200, ['key', 'Escape', 'mouseup', '1'])
    # Its own bar takes it, in another order.

    def moved():
        editor.drag((x, y), (x - 250, y))
        try:
            return until(lambda: order('Main') == ['Second', 'Main', 'Symbols'], 'the other order', 1)
        except AssertionError:
            return False
    until(moved, 'the other order')
    editor.click(editor.all('closed while TRUE: Stop', 'table cell')[0])
    editor.keys('slash')
    until(lambda: len(editor.all('closed while FALSE: Stop', 'table cell')) == 3, 'the negated contact')
    editor.save(paths[0])
    assert lines(paths[0], '@print %QX0.1\nStop=0\nStop=1\n') == ['%QX0.1=1', '%QX0.1=0']
    assert lines(paths[1], '@print %QX0.1\nStop=0\nStop=1\n') == ['%QX0.1=0', '%QX0.1=1']


def closing(screen):
    """a tab is dragged while a key closes another, and right after that: the editor goes on with the tabs that are left"""
    more = SOURCE + ''.join('\nPROGRAM P%d LD\nRUNG\n  | NO Stop | COIL %%QX0.%d |\nEND_PROGRAM\n' % (n, n) for n in range(1, 6))
    editor = Editor(screen, new_file(screen, more, 'many.rung'))
    editor.to_sheet()

    def tab(name):
        found = [node for node in editor.all(name, 'label') if node.name == name and node.box()[0] > PANEL]
        return found[0] if found else None

    def left(*names):
        until(lambda: [name for name in ('Main', 'P1', 'P2', 'P3', 'P4', 'P5') if tab(name)] == list(names), names)
    left('Main', 'P1', 'P2', 'P3', 'P4', 'P5')
    (first, y), (last, _) = editor.centre(tab('Main')), editor.centre(tab('P5'))
    editor.keys('ctrl+Page_Up')
    way = ['mousedown', '1', *[word for x in range(first, last + 30, 20) for word in ('mousemove', str(x), str(y), 'sleep', '0.02')]]
    sh('xdotool', 'mousemove', str(first), str(y), *way, 'key', 'ctrl+shift+w', 'sleep', '0.02', 'mouseup', '1')
    left('P1', 'P2', 'P3', 'P4', 'P5')
    editor.click(tab('P1'))
    (first, y), (last, _) = editor.centre(tab('P2')), editor.centre(tab('P5'))
    way = ['mousedown', '1', *[word for x in range(first, last + 30, 60) for word in ('mousemove', str(x), str(y))]]
    sh('xdotool', 'mousemove', str(first), str(y), 'key', 'ctrl+shift+w', *way, 'sleep', '0.02', 'mouseup', '1')
    left('P2', 'P3', 'P4', 'P5')
    editor.alive()


main([other_window, declared, charts, from_text, hostile, many, a_tab, closing])
