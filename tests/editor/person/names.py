#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""names - find, replace, rename everywhere, and where a name is driven."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
RUNG
  | NO Motor | COIL Lamp |
END_PROGRAM
'''


def rename(screen):
    """rename a symbol everywhere, undo it, redo it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('End', 'F2')
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    editor.keys('ctrl+a')
    editor.type('Pump')
    editor.shot('names-rename')
    editor.keys('Return')
    editor.says('3 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert 'Motor' not in text and text.count('Pump') == 3, text
    check(path)
    assert lines(path, '@print Lamp\nStart=0\nStart=1\n') == ['Lamp=0', 'Lamp=1']
    editor.keys('ctrl+z')
    before = editor.save(path)
    assert 'Pump' not in before and before.count('Motor') == 3, before
    editor.keys('ctrl+shift+z')
    assert editor.save(path) == text
    assert lines(path, '@print Pump\nStart=0\nStart=1\n') == ['Pump=0', 'Pump=1']


def find(screen):
    """find a name, go to the coil that drives it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.keys('ctrl+f')
    editor.type('Lamp')
    editor.keys('Return')
    until(lambda: any('Rung 2' in node.name for node in editor.all('Rung 2')), 'the place of the find')
    editor.shot('names-find')
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('Home', 'F12')
    editor.says('Rung 1')


main([rename, find])
