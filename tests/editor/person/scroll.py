#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""scroll - what is seen of a sheet that is higher than its window is where the cursor is."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, until  # noqa: E402

RUNG = '''RUNG "Pump %d"
(* It runs while its input is on, and from then on by itself.
   Nothing but the switch of the whole plant stops it. *)
  | NO %%IX0.%d     | COIL %%QX0.%d |
  | NO %%QX0.%d   ^ |
'''
PROJECT = 'RUNGBOARD 1\n\nPROGRAM Main LD\n' + ''.join(RUNG % (i, i, i, i) for i in range(4)) + 'END_PROGRAM\n'


def above(editor, *parts):
    """How far below the sheet's upper edge an element begins; None: it is not seen."""
    found = [node for node in editor.elements() if all(part in node.name for part in parts)]
    if not found:
        return None
    _, top, _, high = editor.place(editor.sheet())
    _, y, _, element = editor.place(found[0])
    return y - top if 0 <= y - top <= high - element else None


def again(screen):
    """a sheet that is closed and opened again begins where its cursor is"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+Home')
    first = until(lambda: above(editor, 'Rung 1, NO', '%IX0.0'), 'rung 1')
    editor.keys('ctrl+shift+w')
    until(lambda: not editor.all('Sheet'), 'the sheet to be gone')
    row = min([node for node in editor.all('Main', 'label') if node.name == 'Main'], key=lambda node: node.box()[0])
    editor.click(row, count=2)
    editor.to_sheet()
    editor.says('Rung 1 · column A')
    editor.shot('scroll-again')
    until(lambda: above(editor, 'Rung 1, NO', '%IX0.0') == first, 'rung 1 where it was')


main([again])
