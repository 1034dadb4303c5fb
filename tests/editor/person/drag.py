#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""drag - elements and rungs go where the pointer takes them."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "one"
  | NO Start | NC Stop | COIL Motor |
RUNG "two"
  | NO Motor | COIL Lamp |
END_PROGRAM
'''


def rung_lines(path):
    with open(path) as file:
        return [line.strip() for line in file if line.startswith(('RUNG "', '  |'))]


def elements(screen):
    """an element is dragged into another rung, and back by undo"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    editor.drag(editor.grid(80, 1), editor.grid(80 + 119, 1))
    until(lambda: any('Rung 2' in name and 'Stop' in name for name in editor.cells()), 'Stop in rung 2')
    editor.shot('drag-element')
    editor.save(path)
    check(path)
    assert lines(path, '@print Lamp\nStart=1\nStop=1\n') == ['Lamp=1', 'Lamp=0']
    editor.keys('ctrl+z')
    until(lambda: any('Rung 1' in name and 'Stop' in name for name in editor.cells()), 'Stop in rung 1')


def rungs(screen):
    """a rung is dragged by its number before another"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    x, y = editor.grid(60, 0)
    editor.drag((x - 85, y + 119), (x - 85, y))
    until(lambda: any('Rung 1' in name and 'Lamp' in name for name in editor.cells()), 'the other order')
    editor.save(path)
    assert rung_lines(path)[0] == 'RUNG "two"', rung_lines(path)
    check(path)


def branch(screen):
    """a branch and a wire by keys: open it, fill it, close it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Lamp')
    text = editor.save(path)
    assert 'NO Lamp' in text, text
    check(path)
    editor.keys('ctrl+z')
    until(lambda: not any('Rung 1' in name and 'Lamp' in name for name in editor.cells()), 'the branch to go')


main([elements, rungs, branch])
