#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""spelling - addresses as %QX0.0 or Q0.0: chosen in the preferences, the same on sheets, in panels and in tables."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Level AT %AIW2  : WORD;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | NC %IX0.1 | [ Level > %MW4 ] | COIL %QX0.0 |
END_PROGRAM

PROGRAM Net FBD
NETWORK
  %QX0.3 := AND(Start, %MX0.1)
END_PROGRAM
'''


def choose(editor, key):
    """Chooses the spelling above or below the present one in the preferences and closes them."""
    editor.keys('ctrl+comma')
    editor.focus_on('Light or dark')
    for name in 'Contrast', 'Colour of power', 'Above an element', 'Addresses':
        editor.keys('Tab')
        editor.focus_on(name)
    rows = len(editor.all('IEC 61131-3', 'label'))
    editor.keys('Return')
    until(lambda: len(editor.all('IEC 61131-3', 'label')) > rows, 'the list')
    editor.keys(key, 'Return')
    editor.shot('spelling-chosen')
    until(lambda: editor.keys('Escape') or not editor.all('Contrast'), 'the preferences to be gone')
    editor.to_sheet()


def cell(editor, *parts):
    return until(lambda: [node for node in editor.all(role='table cell') if all(part in node.name for part in parts)],
                 'an element with ' + ' '.join(parts))[0]


def none(editor, text):
    until(lambda: not [node for node in editor.all(role='table cell') if text in node.name], 'no element with ' + text)


def started(screen):
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path, GSETTINGS_BACKEND='keyfile')
    editor.to_sheet()
    return path, editor


def everywhere(screen):
    """chosen in the preferences: the sheet, the table of symbols, networks, cross reference and the panel have it at
    once; the file keeps %IX0.0"""
    path, editor = started(screen)
    cell(editor, '%QX0.0')
    cell(editor, 'Level > %MW4')
    choose(editor, 'Down')
    for text in 'I0.1', 'Q0.0', 'Level > MW4':
        cell(editor, text)
    none(editor, '%')
    editor.shot('spelling-sheet')
    editor.keys('ctrl+Page_Down')
    cell(editor, 'Q0.3')
    none(editor, '%')
    editor.shot('spelling-networks')
    editor.keys('ctrl+alt+s')
    until(lambda: 'AIW2' in [node.text() for node in editor.all('Level, Address', 'text')], 'the address in the table')
    editor.shot('spelling-symbols')
    editor.keys('ctrl+Page_Up', 'ctrl+Page_Up', 'ctrl+Page_Up')
    editor.to_sheet()
    editor.keys('End', 'shift+F12')
    until(lambda: [node.name for node in editor.all('Q0.0', 'label')].count('Q0.0') >= 3, 'the line of the cross reference')
    editor.shot('spelling-uses')
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    until(lambda: [node for node in editor.all(role='list item') if 'Q0.0' in node.name and '%' not in node.name],
          'the coil in the panel')
    until(lambda: [node for node in editor.all(role='list item') if 'Start, I0.0' in node.name], 'Start in the panel')
    editor.shot('spelling-panel')
    editor.keys('ctrl+e')
    assert open(path).read() == PROJECT
    choose(editor, 'Up')
    cell(editor, '%QX0.0')
    cell(editor, 'Level > %MW4')


def typed(screen):
    """either spelling is typed, whatever is shown; the file has one form; a wrong address says why; an operand that is
    opened and taken stays the same"""
    path, editor = started(screen)
    choose(editor, 'Down')
    editor.keys('End', 'Insert')
    until(lambda: editor.all('Rung 2'), 'the new rung')
    editor.keys('Home')
    editor.entry('I0.5')
    cell(editor, 'I0.5')
    editor.entry('%ix0.6')
    cell(editor, 'I0.6')
    editor.entry('MW6 > aiw4')
    cell(editor, 'MW6 > AIW4')
    editor.type('I0.9')
    editor.says('the bits of a byte are 0 to 7')
    editor.shot('spelling-wrong')
    until(lambda: editor.keys('Escape') or not editor.all('I0.9'), 'the entry to be closed')
    text = editor.save(path)
    assert '| NO %IX0.5 | NO %IX0.6 | [ %MW6 > %AIW4 ]' in text, text
    editor.keys('Up', 'Home', 'Right', 'Right', 'Return')
    until(lambda: [node for node in editor.all(role='text') if node.text() == 'Level > MW4'], 'the expression in the entry')
    editor.keys('Return')
    cell(editor, 'Level > MW4')
    editor.keys('Home', 'Return')  # another change, so that there is something to save
    until(lambda: [node for node in editor.all(role='text') if node.text() == 'Start'], 'the contact in the entry')
    editor.keys('ctrl+a')
    editor.type('i0.2')
    editor.keys('Return')
    cell(editor, 'I0.2')
    assert '| NO %IX0.2 | NC %IX0.1 | [ Level > %MW4 ] |' in editor.save(path)


def found(screen):
    """what is read on the sheet is found as it is read"""
    editor = started(screen)[1]
    choose(editor, 'Down')
    for text, hits in ('Q0.0', '1 hit'), ('%QX0.0', '1 hit'), ('MW4', '1 hit'), ('I0.0', '2 hits'), ('q0.7', 'Nothing found'):
        editor.keys('ctrl+f')
        editor.type(text)
        editor.says(hits)


if __name__ == "__main__": main([everywhere, typed, found])
