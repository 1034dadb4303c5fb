#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""text - programs typed as text, and files that cannot be read."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

IL = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main IL
  LD Start
END_PROGRAM
'''
DAMAGED = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor
END_PROGRAM
'''


def typed(screen):
    """an instruction list is typed, with a mistake that is mended"""
    path = new_file(screen, IL)
    editor = Editor(screen, path)
    view = editor.find('Text of the program')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    editor.keys('ctrl+Home', 'Down', 'End', 'Return')
    editor.type('STT Motor')
    editor.says('error')
    editor.shot('text-mistake')
    editor.keys('ctrl+Left', 'BackSpace', 'BackSpace')
    editor.type(' ')
    editor.says('no problems')
    text = editor.save(path)
    assert 'ST Motor' in ' '.join(text.split()), text
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


def damaged(screen):
    """a damaged file opens as text with what is wrong, is mended there, and drawn"""
    path = new_file(screen, DAMAGED)
    editor = Editor(screen, path)
    editor.says('error')
    editor.shot('text-damaged')
    view = editor.find('Text of the program')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    editor.keys('ctrl+End', 'Up', 'Up', 'End')
    editor.type(' |')
    until(lambda: len(editor.cells()) == 2, 'the sheet with its two elements')
    editor.says('no problems')
    editor.shot('text-mended')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


main([typed, damaged])
