#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""keyed - each key of a ladder is pressed in the real window: what the file has then, or what the window shows."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^|
RUNG
  | NO Motor |  | COIL Lamp |
END_PROGRAM
'''
BEFORE = ['NO Start, NC Stop, COIL Motor / NO Motor ^', 'NO Motor, , COIL Lamp']
FIRST, SECOND = BEFORE
GOOD = PROJECT.replace('NO Motor |  | COIL', 'NO Motor | COIL')

# Keys from the first cell; the key; what is typed into the entry, or None; the rungs then.
EDITS = [
    ('Down Down Right', '', 'Start', [FIRST, 'NO Motor, NO Start, COIL Lamp']),  # a letter, a %: the entry by itself
    ('Down Down Right', '', '%IX0.1', [FIRST, 'NO Motor, NO Stop, COIL Lamp']),
    ('Down Down Right', 'F5', 'Start', [FIRST, 'NO Motor, NO Start, COIL Lamp']),
    ('Down Down Right', 'F6', 'Start', [FIRST, 'NO Motor, NC Start, COIL Lamp']),
    ('Down Down End Delete', 'F7', 'Horn', [FIRST, 'NO Motor, COIL Horn']),
    ('Down Down Right', 'F8', 'TON Delay 2s', [FIRST, 'NO Motor, TON Delay PT:=T#2s, COIL Lamp']),
    ('', 'shift+F5', 'Lamp', [FIRST + ' / NO Lamp ^', SECOND]),
    ('', 'shift+F6', 'Lamp', [FIRST + ' / NC Lamp ^', SECOND]),
    ('Down Down Right', 'ctrl+Right', None, [FIRST, 'NO Motor, COIL Lamp']),  # drawn up to the coil
    ('Down Right', 'ctrl+Right', None, [FIRST + ', ---', SECOND]),
    ('Down Right', 'ctrl+Left', None, [FIRST + ', ---', SECOND]),
    ('Down Down Right', 'ctrl+Down', None, [FIRST, SECOND + ' / ^']),
    ('Down Right', 'ctrl+Up', None, [FIRST + ', ^', SECOND]),
    ('Right', 'ctrl+Down', None, [FIRST + ', ^', SECOND]),
    ('Down Down Right', 'F9', None, [FIRST, 'NO Motor, COIL Lamp']),
    ('Down Right', 'shift+F9', None, [FIRST + ' / ^', SECOND]),
    ('', 'slash', None, [FIRST.replace('NO Start', 'NC Start'), SECOND]),
    ('Right', 'slash', None, [FIRST.replace('NC Stop', 'NO Stop'), SECOND]),
    ('End', 'slash', None, [FIRST.replace('COIL', 'COILNOT'), SECOND]),
    ('', 'space', None, [FIRST.replace('NO Start', 'NC Start'), SECOND]),
    ('', 'space space', None, [FIRST.replace('NO Start', 'P Start'), SECOND]),
    ('End', 'space space', None, [FIRST.replace('COIL', 'S'), SECOND]),
    ('', 'Insert', None, [FIRST, '', SECOND]),
    ('', 'shift+Insert', None, ['', FIRST, SECOND]),
    ('', 'alt+Down', None, [SECOND, FIRST]),
    ('Right', 'Delete', None, ['NO Start, COIL Motor / NO Motor ^', SECOND]),
    ('Down Down', 'alt+Up', None, [SECOND, FIRST]),
    ('', 'ctrl+Delete', None, [SECOND]),
    ('', 'ctrl+d', None, [FIRST, FIRST, SECOND]),
    ('', 'Return', 'Stop', [FIRST.replace('NO Start', 'NO Stop'), SECOND]),
]


def rungs(editor, path):
    """The rungs of the file, each on a line: cells, and rows behind a slash."""
    text = editor.save(path).split('PROGRAM Main LD')[1].split('END_PROGRAM')[0]
    cut = lambda row: ', '.join(cell.strip() for cell in ' '.join(row.split()).replace('^', ' ^').strip('| ').split('|'))
    return [' / '.join(' '.join(cut(row).split()) for row in rung.splitlines() if row.strip().startswith('|'))
            for rung in text.split('RUNG')[1:]]


def undone(editor, path):
    """Undoes everything; the file is as before."""
    until(lambda: not editor.find('Undo', 'push button').has(24) or editor.keys('ctrl+z'), 'the end of Undo')
    assert rungs(editor, path) == BEFORE


def edits(screen):
    """each key that changes a rung; Undo takes back what it did"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    for way, key, text, wanted in EDITS:
        editor.keys('ctrl+Home', *way.split(), *key.split())
        if text and key:
            editor.opened()
        if key == 'Return':
            editor.keys('ctrl+a')
        if text:
            editor.entry(text)
        got = rungs(editor, path)
        assert got == wanted, (way, key, text, got, wanted)
        undone(editor, path)


def again(screen):
    """the same key again erases a wire, or makes a contact as it was; a double click edits an operand"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    for way, key, wanted in ('Down Right', 'ctrl+Right', [FIRST + ', ---', SECOND]), ('Right', 'slash', [FIRST.replace('NC Stop', 'NO Stop'), SECOND]), \
            ('Down Right', 'ctrl+Up', [FIRST + ', ^', SECOND]):
        editor.keys('ctrl+Home', *way.split(), key)
        assert rungs(editor, path) == wanted, key
        editor.keys('ctrl+Home', *way.split(), key)
        assert rungs(editor, path) == BEFORE, key
    editor.click(editor.middle(editor.element('Rung 1, NC', 'Stop')), count=2)
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('Lamp')
    assert rungs(editor, path) == [FIRST.replace('Stop', 'Lamp'), SECOND]


def looks_for(screen):
    """the keys that find, replace, rename and go to other places"""
    path = new_file(screen, GOOD)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+f')
    editor.focus_on(role='text')
    editor.type('Lamp')
    editor.says('2 hits')
    editor.keys('Return')
    editor.says('Rung 2 · column F')
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('ctrl+Home', 'F3')
    editor.says('Rung 2 · column F')
    editor.keys('ctrl+Home', 'Down', 'Down')
    editor.says('Rung 2 · column A')
    editor.keys('F12')  # to the coil that drives Motor
    editor.says('Rung 1 · column F')
    editor.keys('shift+F12')
    editor.says('Motor %QX0.0 read, Main, rung 2')
    editor.to_sheet()
    editor.keys('ctrl+Home', 'F2')
    editor.focus_on(role='text')
    editor.keys('ctrl+a')
    editor.type('Begin')
    editor.keys('Return')
    editor.element('Rung 1, NO', 'Begin')
    editor.to_sheet()
    editor.keys('ctrl+h')
    editor.focus_on(role='text')
    editor.type('Stop')
    editor.find('Replace all', 'push button')
    editor.keys('Escape')
    editor.to_sheet()
    editor.brought('ctrl+k')
    editor.find('About Rungboard', 'list item')
    editor.shot('keyed-palette')


def simulates(screen):
    """the keys of the simulation"""
    path = new_file(screen, GOOD)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'ctrl+r')
    editor.says('SIMULATION')
    editor.find('Pause', 'push button')
    editor.keys('space')  # Start
    editor.element('Rung 1, NO', 'Start', ', closed')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.keys('ctrl+r')
    editor.find('Run', 'push button')
    scan = lambda: until(lambda: [node.name for node in editor.all('scan ') if ' · scan ' in node.name], 'the scan')[0]
    before = until(lambda: scan() == scan() and scan(), 'the scan to stand')
    editor.keys('ctrl+t')
    until(lambda: scan() != before, 'another scan')
    editor.keys('Right', 'ctrl+shift+f')
    editor.says('1 force')
    editor.keys('ctrl+shift+f')
    until(lambda: not editor.all('1 force'), 'the force to be released')
    editor.keys('ctrl+m')
    until(lambda: not editor.all('SIMULATION'), 'the editor')


edits.quick = 'editor-gtk/kit'
main([edits, again, looks_for, simulates])
