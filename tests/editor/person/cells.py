#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""cells - elements and branches are cut, copied and pasted within a sheet."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402
from screen import pixels  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Over  AT %IX0.2 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "one"
  | NO Start  | NC Stop | COIL Motor |
  | NO Motor ^|
RUNG "two"
  | NO Over | S Lamp |
END_PROGRAM
'''


def coil(screen):
    """a coil is cut, pasted back, copied to an empty rung and beside another coil; never to a rung where it is always on"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'End', 'ctrl+x')
    until(lambda: not editor.all('Rung 1, COIL', 'table cell'), 'the coil to be gone')
    editor.keys('ctrl+z')
    editor.says('Undone: Cut')
    editor.element('Rung 1, COIL', 'Motor')
    editor.keys('End', 'ctrl+x')
    assert 'COIL' not in editor.save(path)
    editor.keys('ctrl+v')
    editor.element('Rung 1, COIL', 'Motor')
    assert editor.save(path) == PROJECT
    # Anywhere in the row.
    editor.keys('End', 'ctrl+x')
    assert 'COIL' not in editor.save(path)
    editor.keys('Home', 'ctrl+v')
    editor.element('Rung 1, COIL', 'Motor')
    assert editor.save(path) == PROJECT
    # An empty rung gets the coil and its condition.
    editor.keys('End', 'ctrl+c', 'Insert')
    until(lambda: editor.all('Rung 3, S', 'table cell'), 'the new rung')
    editor.keys('ctrl+v')
    editor.element('Rung 2, COIL', 'Motor')
    editor.keys('Home')
    editor.entry('Over')
    assert 'RUNG\n  | NO Over | COIL Motor |\nRUNG "two"' in editor.save(path)
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    assert editor.save(path) == PROJECT
    # Beside an existing output: in parallel.
    editor.keys('ctrl+Home', 'End', 'ctrl+c', 'ctrl+End', 'ctrl+v')
    editor.element('Rung 2, COIL', 'Motor')
    editor.shot('cells-coil')
    text = editor.save(path)
    assert text.count('RUNG "') == 2, text
    check(path)
    assert lines(path, '@print Motor\n%IX0.2=1\n') == ['Motor=1'], text


def on_a_coil(screen):
    """an element that is no output is inserted before the coil at the cursor; also by F5, F6 and the palette"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('OUT Lamp')
    editor.entry('TON T1 5s')
    assert '| NO Start | TON T1 PT:=T#5s | COIL Lamp |' in editor.save(path), open(path).read()
    editor.keys('End', 'F6')
    editor.opened()
    editor.entry('Sens')
    assert '| NO Start | TON T1 PT:=T#5s | NC Sens | COIL Lamp |' in editor.save(path), open(path).read()
    editor.keys('End')
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find an element')
    editor.type('TP')
    editor.keys('Return')
    editor.opened()
    editor.keys('Return')
    editor.gone()
    editor.shot('cells-on-a-coil')
    text = editor.save(path)
    assert '| NC Sens | TP ' in text and '| COIL Lamp |' in text, text
    # An empty last column refuses a contact, too, with a message.
    editor.keys('Insert', 'End', 'F5')
    editor.says('the last column is for outputs only')
    # What is typed next changes no other cell.
    editor.type('Stop')
    editor.keys('Return', 'Escape')
    editor.gone()
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z', 'ctrl+z')
    assert '| NO Start | COIL Lamp |' in editor.save(path)
    check(path)


def branch(screen):
    """contacts and a branch are cut and pasted into another rung; each has one named undo step"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'shift+Down', 'ctrl+c', 'ctrl+End', 'Home', 'ctrl+v')
    until(lambda: len(editor.all('Rung 2, ', 'table cell')) >= 4, 'the branch')
    editor.shot('cells-branch')
    text = editor.save(path)
    check(path)
    assert lines(path, '@print Lamp\n%IX0.2=1\n%IX0.0=1\n') == ['Lamp=0', 'Lamp=1'], text
    editor.keys('ctrl+z')
    editor.says('Undone: Paste')
    assert editor.save(path) == PROJECT


def dragged(screen):
    """a selection is dragged as a whole and has a menu; a click in it selects one cell again"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'shift+Down')
    start, over = [editor.middle(editor.element(*parts)) for parts in (('NO', 'Start'), ('NO', 'Over'))]
    editor.drag(start, over, look='cells-dragged')
    until(lambda: len(editor.all('Rung 2, ', 'table cell')) >= 4, 'the branch in rung 2')
    text = editor.save(path)
    assert 'RUNG "one"\n  | --- | NC Stop | COIL Motor |' in text, text
    assert '| NO Start  | NO Over | S Lamp |\n  | NO Motor ^|' in text, text
    check(path)
    editor.keys('ctrl+z')
    editor.says('Undone: Move elements')
    assert editor.save(path) == PROJECT
    # A drop onto its own place changes nothing.
    editor.keys('ctrl+Home', 'shift+Down')
    editor.drag(start, (start[0] + 20, start[1] + 4))
    editor.keys('ctrl+y')
    until(lambda: len(editor.all('Rung 2, ', 'table cell')) >= 4, 'the branch in rung 2')
    editor.keys('ctrl+z')
    editor.element('Rung 1, NO', 'Start')
    # The menu acts on the whole selection; a click selects a cell.
    editor.keys('ctrl+Home', 'shift+Down')
    editor.click(start, 3)
    until(lambda: [node for node in editor.all('Copy', 'menu item') if node.name == 'Copy'], 'the menu')[0].press()
    until(lambda: not editor.all('Copy', 'menu item'), 'the menu to be gone: it would take the click')
    editor.click(over)
    editor.keys('ctrl+v')
    until(lambda: len(editor.all('Rung 2, ', 'table cell')) >= 4, 'the branch in rung 2')
    editor.keys('ctrl+z', 'ctrl+Home', 'shift+Down')
    editor.click(start)
    editor.keys('Delete')
    until(lambda: not editor.all('Rung 1, NO, Start', 'table cell'), 'Start to be gone')
    assert 'NO Motor' in editor.save(path)


coil.quick = 'editor-gtk/ladder'
def back(screen):
    """Undo moves the cursor to where the edit began"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'Right')
    place = until(lambda: editor.all('Rung 1 ', 'label'), 'the place')[0].name
    editor.entry('Extra')
    until(lambda: not editor.all(place, 'label'), 'the cursor to go on')
    editor.keys('ctrl+z')
    editor.says(place)
    editor.entry('Extra')
    editor.keys('ctrl+End')
    until(lambda: not editor.all(place, 'label'), 'the cursor elsewhere')
    editor.keys('ctrl+z')
    editor.says(place)
    editor.shot('cells-back')


def paper(screen):
    """a sheet has no grid until the cursor moves: by a key, or by a click; then the rung of the cursor has a faint one"""
    faint = (0xe4, 0xe4, 0xe6)

    def seen(editor, rung_y, rows):
        x, y, _, _ = editor.place(editor.sheet())
        return [pixels(x + 61 + 98 * column, y + rung_y + 36 + 84 * rows - 4, 1, 3) == [faint] * 3 for column in (2, 3, 4)]
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    two = 36 + 2 * 84 + 9
    assert not any(seen(editor, 0, 2) + seen(editor, two, 1))
    editor.keys('Right')
    until(lambda: all(seen(editor, 0, 2)), 'the grid of rung 1')
    assert not any(seen(editor, two, 1))
    editor.click(editor.grid(two + 36 + 46, 0))
    until(lambda: all(seen(editor, two, 1)), 'the grid of rung 2')
    assert not any(seen(editor, 0, 2))
    editor.shot('cells-grid')


on_a_coil.quick = 'editor-gtk/edit'
main([coil, on_a_coil, branch, dragged, back, paper])
