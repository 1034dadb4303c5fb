#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""words - what is typed: a list with completion and undo, a word that goes in parallel, what the editor tells."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

LIST = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL; (* the green button *)
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main IL
  LD    Start
  ST    Motor
END_PROGRAM
'''


def file_with(screen, text):
    path = new_file(screen)
    with open(path, 'w') as out:
        out.write(text)
    return path


def a_list(screen):
    """a list: what is typed goes into the file, a word is completed, Ctrl+Z takes it back"""
    path = file_with(screen, LIST)
    editor = Editor(screen, path)
    editor.click(until(lambda: editor.all('Text of the program', 'text'), 'the list')[0])
    editor.keys('ctrl+End', 'Up', 'Up', 'End', 'Return')
    editor.type('ANDN Mo')
    editor.keys('ctrl+space')
    editor.shot('list-words')
    editor.keys('Return')
    text = editor.save(path)
    assert 'ANDN  Motor' in text, text
    check(path)
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    assert editor.save(path) == LIST
    editor.keys('ctrl+End', 'Up', 'Up', 'End', 'Return')
    editor.type('LD Nobody')
    editor.shot('list-wrong')
    until(lambda: editor.all('Nobody', 'label'), 'what is wrong')


def in_parallel(screen):
    """OR X goes below what the cursor is on; the status bar says what comes next"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('OUT Motor')
    editor.keys('Home')
    until(lambda: editor.all('Negate', 'label'), 'what the next key does')
    editor.entry('OR Motor')
    text = editor.save(path)
    assert 'NO Motor ^|' in text, text
    check(path)


def other_keys(screen):
    """keys of another editor, chosen in the preferences, hold at once"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.keys('ctrl+comma')
    editor.find('Keys as in')
    editor.keys('Tab', 'Tab', 'Tab', 'Return', 'Down', 'Down', 'Down')
    editor.shot('preferences')
    editor.keys('Return', 'Escape')
    until(lambda: not editor.all('Keys as in'), 'the preferences to be gone')
    editor.keys('c')
    editor.opened()
    editor.entry('Start')
    editor.keys('l')
    editor.opened()
    editor.entry('Motor')
    editor.keys('Home', 'n')
    text = editor.save(path)
    assert '| NC Start | COIL Motor |' in text, text


main([a_list, in_parallel, other_keys])
