#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""spelling - addresses as %QX0.0 or Q0.0: chosen in the preferences, the same on sheets, in panels and in tables."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from chart_quality import chart_of, told  # noqa: E402
from desk import Editor, main, new_file, until  # noqa: E402
from iomap import open_map  # noqa: E402

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

PLANT = '''RUNGBOARD 1

PROGRAM Main LD
RUNG
  | NO %IX0.0 | NO %IX20.0 | [ %IW2 > 5 ] | COIL %QX0.0 |
END_PROGRAM

PROGRAM Wash SFC
VAR
  Valve AT %QX0.3 : BOOL;
END_VAR

INITIAL_STEP Wait:
END_STEP

STEP Fill:
  Valve(N);
END_STEP

TRANSITION FROM Wait TO Fill := %IX0.1;
END_TRANSITION

TRANSITION FROM Fill TO Wait := %IX0.2;
END_TRANSITION
END_PROGRAM

VIEW
  timing %IX0.0
  timing %IW2
END_VIEW
'''
MAP = '''BOARD "plant"
BUS Q9   modbus-tcp host=127.0.0.1:9
%IX0.0..2  sim
%IW2     modbus bus=Q9 unit=1 input-register=0 stale=400ms substitute=77
%IX20.0  quality of=%IW2
%QX0.0   sim safe=0
'''


def choose(editor, key, sheet=True):
    """Chooses the spelling above or below the present one in the preferences and closes them. @sheet: the sheet had the
    focus, and has it again."""
    editor.keys('ctrl+comma')
    editor.focus_on('Light or dark')
    for name in 'Contrast', 'Colour of power', 'Above an element', 'Addresses':
        editor.keys('Tab')
        editor.focus_on(name)
    rows = len(editor.all('IEC: %IX0.0', 'label'))
    editor.keys('Return')
    until(lambda: len(editor.all('IEC: %IX0.0', 'label')) > rows, 'the list')
    editor.keys(key, 'Return')
    editor.shot('spelling-chosen')
    until(lambda: editor.keys('Escape') or not editor.all('Contrast'), 'the preferences to be gone')
    if sheet:
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


def texts(editor, name):
    return [node.text() for node in editor.all(name, 'text') if node.name == name]


def has(editor, name, text):
    until(lambda: texts(editor, name) == [text], '"%s" to be %s' % (name, text))


def map_and_interface(screen):
    """the table of an I/O map and the variables above a chart: shown and typed in the chosen form, kept in the first"""
    path = new_file(screen, PLANT, 'plant.rung')
    io = os.path.join(screen.home, 'plant.io')
    with open(io, 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path, GSETTINGS_BACKEND='keyfile')
    editor.to_sheet()
    choose(editor, 'Down')
    editor.keys('ctrl+Page_Down')
    editor.click(until(lambda: [n for n in editor.all('Variables', 'push button') if n.box()[2] > 0], 'the heading')[0])
    has(editor, 'Valve, Address', 'Q0.3')
    editor.shot('spelling-interface')
    editor.into('Valve, Address')
    editor.keys('ctrl+a')
    editor.type('q0.4')
    editor.keys('Return')
    has(editor, 'Valve, Address', 'Q0.4')
    assert '  Valve AT %QX0.4 : BOOL;' in editor.save(path)
    open_map(editor, 'plant.io')
    has(editor, 'I0.0..2, Address', 'I0.0..2')
    editor.find('Used by the program, missing in the map: Q0.4 Wash.Valve')
    editor.shot('spelling-map')
    editor.into('I0.0..2, Address')
    editor.keys('ctrl+a')
    editor.type('i0.0..5')
    editor.keys('Return')
    has(editor, 'I0.0..5, Address', 'I0.0..5')
    editor.into('Q0.0, Comment')
    editor.type('pump')
    editor.keys('Return')
    has(editor, 'Q0.0, Comment', 'pump')
    editor.tab('Analog (1)')
    has(editor, 'I20.0, Quality of', 'IW2')
    editor.tab('Buses (1)')
    has(editor, 'Q9, Name', 'Q9')
    text = editor.save(io)
    assert text == MAP.replace('0.0..2', '0.0..5').replace('%QX0.0   sim safe=0', '%QX0.0   sim safe=0   # pump'), text
    editor.tab('Pins (2)')
    choose(editor, 'Up', sheet=False)
    has(editor, '%IX0.0..5, Address', '%IX0.0..5')


def name_end(editor, chart):
    """The last column of the first name in the timing chart that is not empty."""
    x, y, _, _ = editor.place(chart)
    width, height = 110, 30
    grey = subprocess.run(['import', '-window', 'root', '-crop', '%dx%d+%d+%d' % (width, height, x, y), '-colorspace',
                           'gray', '-depth', '8', 'gray:-'], capture_output=True, check=True).stdout
    return max([at % width for at, each in enumerate(grey) if abs(each - grey[0]) > 80], default=0)


def timing_chart(screen):
    """the timing chart draws and tells addresses in the chosen form"""
    path = new_file(screen, PLANT, 'plant.rung')
    with open(os.path.join(screen.home, 'plant.io'), 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path, GSETTINGS_BACKEND='keyfile')
    editor.to_sheet()
    editor.keys('ctrl+t')
    editor.says('scan 1')
    chart = chart_of(editor)
    until(lambda: told(chart) == '%IW2: stale', 'the input to be bad')
    long = name_end(editor, chart)
    choose(editor, 'Down', sheet=False)
    until(lambda: 0 < name_end(editor, chart) < long - 10, 'a shorter name')
    editor.shot('spelling-timing')
    editor.keys('ctrl+t')
    until(lambda: told(chart) == 'IW2: stale', 'the input to be bad')


if __name__ == "__main__": main([everywhere, typed, found, map_and_interface, timing_chart])
