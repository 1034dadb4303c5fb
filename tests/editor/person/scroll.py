#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""scroll - the visible part of a sheet that is higher than its window contains the cursor."""
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, sh, until, urge  # noqa: E402

RUNG = '''RUNG "Pump %d"
(* It runs while its input is on, and from then on by itself.
   Nothing but the switch of the whole plant stops it, which is beside the door. *)
  | NO %%IX0.%d     | COIL %%QX0.%d |
  | NO %%QX0.%d   ^ |
'''
PROJECT = 'RUNGBOARD 1\n\nPROGRAM Main LD\n' + ''.join(RUNG % (i, i, i, i) for i in range(4)) + 'END_PROGRAM\n'


def above(editor, *parts):
    """How far below the sheet's upper edge an element begins; None: it is not visible."""
    found = [node for node in editor.elements() if all(part in node.name for part in parts)]
    if not found:
        return None
    _, top, _, high = editor.place(editor.sheet())
    _, y, _, element = editor.place(found[0])
    return y - top if 0 <= y - top <= high - element else None


def tree_row(editor, name):
    """The row of the tree is the leftmost label of that name."""
    return min([node for node in editor.all(name, 'label') if node.name == name], key=lambda node: node.box()[0])


def again(screen):
    """a sheet that is closed and opened again begins at its cursor"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+Home')
    first = until(lambda: above(editor, 'Rung 1, NO', '%IX0.0'), 'rung 1')
    editor.keys('ctrl+shift+w')
    until(lambda: not editor.all('Sheet'), 'the sheet to be gone')
    # From the tree, whose rows may still move.
    urge(lambda: editor.all('Sheet'), lambda: editor.click(tree_row(editor, 'Main'), count=2), 'the sheet')
    editor.to_sheet()
    editor.says('Rung 1 · column A')
    editor.shot('scroll-again')
    until(lambda: above(editor, 'Rung 1, NO', '%IX0.0') == first, 'rung 1 where it was')


def beside(editor, *parts):
    """Is an element between the left and the right edge of the sheet?"""
    left, _, wide, _ = editor.place(editor.sheet())
    found = [node for node in editor.elements() if all(part in node.name for part in parts)]
    x, _, width, _ = editor.place(found[0]) if found else (0, 0, 0, 0)
    return bool(found) and left <= x and x + width <= left + wide


def zoomed(screen):
    """zooming by keys keeps the cursor in sight; a cursor out of sight stays so"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    for place, name in (('ctrl+Home',), ('Rung 1, NO', '%IX0.0')), (('End',), ('Rung 1, COIL', '%QX0.0')), \
            (('ctrl+End', 'End'), ('Rung 4, COIL', '%QX0.3')):
        editor.keys(*place, *['ctrl+plus'] * 7)
        editor.says('300 %')
        until(lambda: above(editor, *name) is not None and beside(editor, *name), '%s to be seen' % name[1])
        editor.shot('scroll-zoomed-' + place[-1].replace('+', '-'))
        editor.keys(*['ctrl+minus'] * 10)
        editor.says('50 %')
        until(lambda: above(editor, *name) is not None and beside(editor, *name), '%s to be seen' % name[1])
        editor.keys('ctrl+0')
        editor.says('100 %')
    # The pointer is elsewhere.
    editor.keys('ctrl+Home')
    until(lambda: above(editor, 'Rung 1, NO'), 'rung 1')
    until(lambda: editor.click(editor.sheet(), 5, 20) or above(editor, 'Rung 4, NO'), 'rung 4')
    editor.keys('ctrl+plus')
    editor.says('125 %')
    editor.shot('scroll-zoomed-elsewhere')
    until(lambda: not editor.all('Rung 1, NO') and editor.all('Rung 4, NO'), 'rung 4 to stay')


WIDE = '''RUNGBOARD 1

PROGRAM Main LD
%sEND_PROGRAM
''' % ''.join('RUNG "%d"\n  | %s | COIL %%QX%d.0 |\n' % (rung, ' | '.join('NO %%IX%d.%d' % (rung, bit) for bit in range(8)) + ' | ' +
                                                    ' | '.join('NO %%MX%d.%d' % (rung, bit) for bit in range(8)), rung)
            for rung in range(1, 9))


def pointed(screen):
    """zooming by the wheel keeps what is below the pointer there: in long rungs, and in folded ones"""
    editor = Editor(screen, new_file(screen, WIDE))
    editor.to_sheet()
    for fold in (), ('alt+z',):
        editor.keys(*fold, 'ctrl+Home')
        until(lambda: editor.all('Rung 2, NO', 'table cell'), 'rung 2')
        name = '%IX2.4'
        at = editor.middle(editor.element('Rung 2, NO', name))
        sh('xdotool', 'mousemove', str(at[0]), str(at[1]), 'sleep', '0.2')

        def stays():
            found = [node for node in editor.all('Rung 2, NO', 'table cell') if name in node.name]
            if not found:
                return False
            x, y, width, height = editor.place(found[0])
            # The wire is 46 px of 84 below the top. Folded rungs are as wide as the sheet, whatever the zoom.
            return (bool(fold) or abs(x + width / 2 - at[0]) <= 3) and abs(y + height * 46 / 84 - at[1]) <= 3
        for button, zoom in (4, '110 %'), (4, '121 %'), (4, '133 %'), (5, '121 %'), (5, '110 %'):
            sh('xdotool', 'keydown', 'ctrl', 'click', str(button), 'keyup', 'ctrl')
            editor.says(zoom)
            until(stays, 'the element to be below the pointer at ' + zoom)
            editor.shot('scroll-pointed-' + zoom[:3] + '-'.join(fold))
        editor.keys('ctrl+0')
        editor.says('100 %')


def head(screen):
    """going to the first row of a rung by keys shows its title and comment; a click does not scroll"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+Home')
    first = until(lambda: above(editor, 'Rung 1, NO', '%IX0.0'), 'rung 1')
    for back in ['ctrl+Home'], ['Up'] * 7, ['Page_Up']:
        editor.keys('ctrl+End', 'Down')
        editor.says('Rung 4 · row 2 · column A')
        until(lambda: above(editor, 'Rung 4, NO', '%QX0.3'), 'rung 4')
        editor.keys(*back)
        editor.says('Rung 1 · column A')
        until(lambda: above(editor, 'Rung 1, NO', '%IX0.0') == first, 'the top of the sheet')
    editor.shot('scroll-head')
    editor.keys('ctrl+End', *['Up'] * 4)
    editor.says('Rung 2 · column A')
    editor.shot('scroll-head-2')
    until(lambda: (above(editor, 'Rung 2, NO', '%IX0.1') or 0) >= first, 'all of rung 2')
    # The clicked element stays below the pointer.
    editor.keys('ctrl+Home', 'ctrl+plus', 'ctrl+plus', 'ctrl+plus')
    first = until(lambda: above(editor, 'Rung 1, NO', '%IX0.0'), 'rung 1')
    editor.keys('ctrl+End')
    editor.says('Rung 4 · column A')
    until(lambda: editor.click(editor.sheet(), 4, 20) or above(editor, 'Rung 1, NO', '%IX0.0') == first, 'the top of the sheet')
    editor.click(editor.sheet(), 5)
    now = until(lambda: (above(editor, 'Rung 1, NO', '%IX0.0') or first) < first and
                above(editor, 'Rung 1, NO', '%IX0.0'), 'the title above the edge')
    editor.click(editor.element('Rung 1, COIL', '%QX0.0'))
    editor.says('Rung 1 · column F')
    editor.shot('scroll-head-clicked')
    assert above(editor, 'Rung 1, NO', '%IX0.0') == now > 40, now


MANY = 8000


def bands(editor):
    """The number of colours in the upper, the middle and the lower third of what is seen of the sheet."""
    x, y, width, height = editor.place(editor.sheet())
    found = []
    for third in range(3):
        body = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '%dx%d+%d+%d' % (
            width - 40, height // 3, x + 10, y + third * height // 3), 'rgb:-'], capture_output=True).stdout
        found.append(len({body[at:at + 3] for at in range(0, len(body), 3)}))
    return found


def drawn(editor, what):
    until(lambda: min(bands(editor)) > 5, 'a picture in each third of the sheet ' + what, 20)


def long(screen):
    """8,000 rungs: behind each scrolling, by keys, wheel and bar, there are rungs in each part of the sheet"""
    text = ''.join('RUNG\n  | NO %%MX%d.%d | COIL %%MX%d.%d |\n' % (i // 8 % 500, i % 8, 500 + i // 8 % 500, i % 8) for i in range(MANY))
    editor = Editor(screen, new_file(screen, 'RUNGBOARD 1\n\nPROGRAM Main LD\n' + text + 'END_PROGRAM\n'))
    editor.to_sheet()
    drawn(editor, 'when it opens')
    editor.keys('ctrl+End')
    editor.says('Rung %d · column' % MANY)
    until(lambda: editor.all('Rung %d, COIL' % MANY), 'the last rung')
    editor.shot('scroll-long-end')
    editor.keys(*['Prior'] * 12)
    drawn(editor, 'by pages')
    number = until(lambda: seen(editor), 'rungs')
    assert MANY - 200 < number < MANY, number
    for _ in range(4):
        editor.click(editor.sheet(), 4, 20)
        drawn(editor, 'by the wheel')
    assert until(lambda: seen(editor), 'rungs') < number
    x, y, width, height = editor.place(editor.sheet())
    for part in 5, 2, 8, 1:
        editor.click((x + width + 6, y + height * part // 10))
        drawn(editor, 'by the bar')
    editor.keys('ctrl+Home')
    editor.says('Rung 1 · column A')
    until(lambda: editor.all('Rung 1, NO'), 'the first rung')
    drawn(editor, 'at its begin')
    editor.brought('ctrl+g')
    editor.focus_on(role='text')
    editor.type('4000')
    editor.keys('Return')
    editor.says('Rung 4000 · column')
    drawn(editor, 'in its middle')
    until(lambda: editor.all('Rung 4000, NO'), 'the rung')
    editor.shot('scroll-long-middle')
    editor.finish()


def seen(editor):
    """The number of the first rung that is seen."""
    found = [re.match(r'Rung (\d+), ', node.name) for node in editor.elements()]
    numbers = [int(one.group(1)) for one in found if one]
    return min(numbers) if numbers else None


main([again, zoomed, pointed, head, long])
