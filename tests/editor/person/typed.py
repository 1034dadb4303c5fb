#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""typed - what is typed at a cell: addresses in expressions, returns and jumps, special bits of other tools."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Level AT %MW4 : INT;
  Lamp  AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG First
  | NO Start | COIL Lamp |
RUNG
  | [ Level > 5 ] | COIL %QX0.0 |
RUNG
  | NO %IX0.3 | COIL Lamp |
RUNG
END_PROGRAM
'''


def file_with(screen, text):
    path = new_file(screen)
    with open(path, 'w') as out:
        out.write(text)
    return path


def coils(screen):
    """three coils of one output: each is marked on the sheet and has its line in Problems"""
    editor = Editor(screen, file_with(screen, PROJECT))
    editor.to_sheet()

    def told(name):
        return [node for node in editor.all(name, 'label') if 'coils in more than one place' in node.name]
    until(lambda: len(told('Lamp')) == 2 and len(told('%QX0.0')) == 1, 'the problems')
    editor.shot('coils-twice')


def addresses(screen):
    """an address in an expression becomes the symbol there, or its canonical spelling; a jump and a return"""
    path = file_with(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+End', 'Home')
    editor.entry('i0.0 AND mw4 > 7 OR X5')
    editor.keys('End')
    editor.entry('>>First')
    editor.keys('Insert', 'Home')
    editor.entry('I0.2')
    editor.keys('End')
    editor.entry('-<RETURN>-')
    editor.shot('typed-addresses')
    text = editor.save(path)
    assert '| [ Start AND Level > 7 OR %IX0.5 ] | JMP First |' in text, text
    assert '| NO %IX0.2 | RET |' in text, text
    check(path)


def special(screen):
    """a special relay of another tool is refused at the entry, with the word to write"""
    editor = Editor(screen, file_with(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+End', 'Home')
    editor.type('M8000')
    until(lambda: editor.all('write SYS_ALWAYS_ON'), 'the reason')
    editor.shot('special')
    editor.keys('Escape')


if __name__ == '__main__':
    main([coils, addresses, special])
