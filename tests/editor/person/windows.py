#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""windows - rungs go from window to window, and from any text editor, as text."""
import os
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


PANEL = 230  # px, of the tree
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


def from_text(screen):
    """a rung typed in any text editor is pasted"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.put_clipboard('RUNG\n  | NO Start | COIL Motor |\n')
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 2, 'the elements')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']
    editor.put_clipboard('this is no rung')
    editor.keys('ctrl+v')
    assert len(editor.cells()) == 2, 'what is no rung was pasted'


def many(screen):
    """thousands of rungs are pasted, all of them; more than a program holds are none, and that is told"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    rung = 'RUNG\n  | NO Start | COIL Motor |\n'
    editor.put_clipboard(rung * 50001)
    editor.keys('ctrl+v')
    editor.says('too many in one project')
    assert open(path).read() == TARGET
    editor.put_clipboard(rung * 3000)
    editor.keys('ctrl+v')
    until(lambda: editor.all('3000 rungs', 'label'), 'the rungs in the tree')
    assert editor.save(path).count(rung) == 3000
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def a_tab(screen):
    """a tab stays in the window of its project: another takes none, and let go anywhere it comes back to its place"""
    more = SOURCE + '\nPROGRAM Second LD\nRUNG\n  | NO Stop | COIL %QX0.1 |\nEND_PROGRAM\n'
    paths = new_file(screen, more, 'one.rung'), new_file(screen, more.replace('Main', 'Other'), 'two.rung')
    editor = Editor(screen, *paths)
    one, two = until(lambda: len(editor.windows()) == 2 and sorted(editor.windows(), key=int), 'two windows')
    for window, x, y in (one, 0, 0), (two, 300, 720):
        sh('xdotool', 'windowsize', '--sync', window, '1024', '700', 'windowmove', '--sync', window, str(x), str(y))

    def tabs(name):
        """Of the window with that program, from left to right: right of the tree, and of a tooltip's corner."""
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

    def let_go(below):
        """Dragged straight down. Again: GTK 4.8 loses some presses after something was dragged away."""
        def done():
            way = [step for by in range(0, below + 1, below // 10) for step in
                   ('mousemove', str(x), str(y + by), *(() if by else ('mousedown', '1')), 'sleep', '0.03')]
            sh('xdotool', *way, 'sleep', '0.2')
            out = order('Main') == ['Main', 'Symbols']
            editor.shot('windows-tab-%d' % below)
            sh('xdotool', 'mouseup', '1')
            return out
        until(done, 'the tab to be out of its bar')
        stay()
    for below in 720, 200:
        let_go(below)
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


main([other_window, from_text, many, a_tab])
