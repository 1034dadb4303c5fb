#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""seal_in - a motor seal-in from an empty sheet: by keyboard alone and by pointer alone."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, trace, until  # noqa: E402

BEHAVIOUR = '''@print Motor
Start=0 Stop=0
Start=1
Start=0
.
Stop=1
Stop=0
'''
WANTED = ['Motor=0', 'Motor=1', 'Motor=1', 'Motor=1', 'Motor=0', 'Motor=0']


def behaves(path):
    check(path)
    got = [line.split()[-1] for line in trace(path, BEHAVIOUR).splitlines()]
    assert got == WANTED, 'it does not seal itself in: %s\n%s' % (got, open(path).read())


def by_keyboard(screen):
    """a motor seal-in from an empty sheet, by keyboard alone"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('XIO Stop')
    editor.entry('OUT Motor')
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Motor')
    editor.shot('seal-in-keyboard')
    text = editor.save(path)
    assert 'Start AT %IX0.0' in text and 'Motor AT %QX0.0' in text, text
    behaves(path)
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z', 'ctrl+z')
    empty = editor.save(path)
    assert 'COIL' not in empty and 'Start' not in empty, empty
    editor.keys('ctrl+shift+z', 'ctrl+shift+z', 'ctrl+shift+z', 'ctrl+shift+z')
    assert editor.save(path) == text


def by_signs(screen):
    """the same typed with signs; on an element a slash still negates it"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('Stop')  # a name, not the word STOP
    editor.keys('Left', 'slash')
    editor.element('NC', 'Stop')
    editor.keys('Right')
    editor.entry('= Motor')
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Motor')
    assert '| NO Start  | NC Stop | COIL Motor |' in editor.save(path), open(path).read()
    behaves(path)
    editor.keys('ctrl+Home', 'slash')
    editor.element('NC', 'Start')
    editor.keys('slash')
    editor.element('NO', 'Start')
    editor.keys('Insert')
    for line in '-|/|- Stop', '|P| Start', '!Motor', '-(S)- Lamp':
        editor.entry(line)
    assert '| NC Stop | P Start | NC Motor | S Lamp |' in editor.save(path), open(path).read()
    check(path)


SYMBOLS = '''RUNGBOARD 1

VAR_GLOBAL
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
END_PROGRAM
'''


def choose(editor, *parts):
    """Clicks a candidate of the open entry."""
    editor.opened()
    editor.click(editor.popped(editor.candidate(*parts)))
    editor.gone()


def by_pointer(screen):
    """the same by pointer: elements from the palette, the branch as a wire, symbols from the list"""
    path = new_file(screen, SYMBOLS)
    editor = Editor(screen, path)
    editor.keys = editor.type = None  # nothing is typed
    contact = editor.tile('closed while TRUE')
    negated = editor.tile('closed while FALSE')
    coil = editor.tile('TRUE while powered')
    for tile, column, name in (contact, 0, 'Start'), (negated, 1, 'Stop'), (coil, 5, 'Motor'):
        editor.drag(tile, editor.grid(60, column))
        choose(editor, name)
    # From the wire left of Start around it to the wire right of it: a row is added below.
    editor.drag(editor.wire_end(60, 0, 10), editor.wire_end(60, 1, 10), look='seal-in-branch')
    editor.says('This branch is empty')
    editor.drag(contact, editor.grid(60 + 84, 0))
    choose(editor, 'Motor')
    editor.shot('seal-in-pointer')
    editor.click(editor.find('Save', 'push button'))
    until(lambda: 'Motor ^' in open(path).read(), 'the branch in the file')
    behaves(path)


by_keyboard.quick = 'editor-gtk/window'
main([by_keyboard, by_signs, by_pointer])
