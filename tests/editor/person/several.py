#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""several - several rungs are selected, then copied, moved, duplicated, switched off, deleted; by keys and by
pointer.
"""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

PROGRAM Main LD
VAR
  D1 : TON;
END_VAR
RUNG "a"
  | NO %IX0.0 | COIL %QX0.0 |
RUNG "b"
  | NO %IX0.1  | TON D1 PT:=T#1s | COIL %QX0.1 |
  | NO %IX0.2 ^|
RUNG "c"
  | NO D1.Q | COIL %QX0.2 |
RUNG "d"
  | NO %IX0.3 | COIL %QX0.3 |
END_PROGRAM
'''


def order(text):
    return ''.join(re.findall(r'"(\w)"', text))


def opened(screen):
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.element('Rung 4')
    return path, editor


def by_keys(screen):
    """Shift+Down past the end of a rung selects whole rungs; verbs act on all of them"""
    path, editor = opened(screen)
    editor.keys('Down', 'shift+Down', 'shift+Down')
    editor.says('Rungs 2 to 3 are selected')
    editor.shot('several-keys')
    editor.keys('alt+Down')
    editor.says('Rungs 3 to 4 are selected')
    assert order(editor.save(path)) == 'adbc'
    editor.keys('alt+Up', 'alt+Up')
    editor.says('Rungs 1 to 2 are selected')
    assert order(editor.save(path)) == 'bcad'
    editor.keys('alt+Up')  # it is the first one
    # Copied behind the last rung; the instance is named, so it stays.
    editor.keys('ctrl+c', 'ctrl+End', 'ctrl+v')
    editor.element('Rung 6')
    assert order(editor.save(path)) == 'bcadbc'
    editor.keys('ctrl+z')
    # Duplicated, with a timer for both of them.
    editor.keys('ctrl+Home', 'shift+Down', 'shift+Down', 'ctrl+d')
    editor.says('D2 : TON')
    text = editor.save(path)
    assert order(text) == 'bcbcad' and text.count('TON D2 PT:=T#1s') == 1 and text.count('NO D2.Q') == 1, text
    check(path)
    editor.keys('Delete')
    until(lambda: len([n for n in editor.cells() if 'Rung 5' in n]) == 0, 'four rungs')
    assert order(editor.save(path)) == 'bcad'
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z', 'ctrl+z', 'ctrl+z')
    assert editor.save(path) == PROJECT


def by_pointer(screen):
    """a click on a number selects that rung, with Shift up to there; cut and paste"""
    path, editor = opened(screen)
    x, y = editor.grid(60, 0)
    editor.click((x - 85, y))
    editor.click((editor.place(editor.element('Rung 3', 'D1.Q'))[0] - 40, editor.middle(editor.element('Rung 3', 'D1.Q'))[1]),
                 shift=True)
    editor.says('Rungs 1 to 3 are selected')
    editor.shot('several-pointer')
    editor.keys('ctrl+x')
    until(lambda: len(editor.elements()) == 2, 'one rung')
    assert order(editor.save(path)) == 'd'
    editor.keys('ctrl+v')
    editor.element('Rung 4')
    assert order(editor.save(path)) == 'dabc'
    editor.keys('ctrl+z', 'ctrl+z')
    assert editor.save(path) == PROJECT


def dragged(screen):
    """selected rungs are dragged together by the number of any of them, in one step"""
    path, editor = opened(screen)
    left = editor.grid(60, 0)[0] - 85
    numbers = [(left, editor.middle(editor.element('Rung %d' % n))[1]) for n in (1, 2, 3)]
    editor.click(numbers[0])
    editor.click(numbers[1], shift=True)
    editor.says('Rungs 1 to 2 are selected')
    editor.drag(numbers[0], (left, numbers[2][1] + 30), look='several-dragged')
    editor.says('Rungs 2 to 3 are selected')
    assert order(editor.save(path)) == 'cabd'
    editor.keys('ctrl+z')
    editor.says('Undone: Move rung')
    assert editor.save(path) == PROJECT
    # Upwards, by the second one.
    editor.keys('ctrl+Home')
    editor.click(numbers[1])
    editor.click(numbers[2], shift=True)
    editor.says('Rungs 2 to 3 are selected')
    editor.drag(numbers[2], (left, numbers[0][1] - 30))
    editor.says('Rungs 1 to 2 are selected')
    assert order(editor.save(path)) == 'bcad'
    # A click on one of them selects it alone.
    editor.click(numbers[1])
    until(lambda: not editor.all('are selected'), 'one rung')


def all_of_them(screen):
    """Ctrl+A selects the rung, again all rungs; Esc clears the selection; all can be deleted"""
    path, editor = opened(screen)
    editor.keys('ctrl+a', 'ctrl+a')
    editor.says('Rungs 1 to 4 are selected')
    editor.keys('Escape')
    until(lambda: not editor.all('are selected'), 'nothing selected')
    editor.keys('ctrl+a', 'ctrl+a', 'ctrl+Delete')
    until(lambda: not editor.elements(), 'an empty rung')
    text = editor.save(path)
    assert text.count('RUNG\n') == 1 and order(text) == '', text
    editor.keys('ctrl+z')
    assert editor.save(path) == PROJECT


main([by_keys, by_pointer, dragged, all_of_them])
