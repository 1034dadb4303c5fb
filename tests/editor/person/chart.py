#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chart - the timing chart.

Its cursor selects the scan that the rungs show; why a coil is off; a rung is added while the program runs.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^|
END_PROGRAM
'''
NAMES = 210  # px of the names at the left of the chart


def scans(editor, count):
    for _ in range(count):
        editor.keys('ctrl+t')


def toggle(editor, *parts):
    editor.click(editor.beside(editor.element(*parts)))
    editor.keys('space')


def session(screen, **env):
    """Five scans with no input, five with Start, five with Stop, 150 ms in all; then paused."""
    editor = Editor(screen, new_file(screen, PROGRAM), **env)
    editor.to_sheet()
    scans(editor, 5)
    editor.says('scan 5')
    toggle(editor, 'NO', 'Start', 'open')
    scans(editor, 5)
    editor.element('COIL', ', on')
    toggle(editor, 'NC', 'Stop', 'closed')
    scans(editor, 5)
    editor.element('COIL', ', off')
    editor.says('scan 15')
    return editor


def rewind(screen):
    """the rungs show the scan at the cursor of the timing chart; keys step it; End returns to the present"""
    editor = session(screen)
    editor.tab('Timing chart')
    chart = editor.find('Timing chart, cursor')
    editor.click(editor.find('Show all recorded scans'))
    x, y, width, _ = editor.place(chart)
    at = lambda scan: (x + NAMES + (width - NAMES) * scan * 10 // 150 + 3, y + 20)
    editor.drag(at(3), at(7), look='chart-past')
    editor.says('PAST · scan 7')
    editor.element('COIL', ', on')
    editor.keys('Left', 'Left')
    editor.says('PAST · scan 5')
    editor.element('COIL', ', off')
    editor.keys('Right', 'Right', 'Right', 'Right', 'Right', 'Right')
    editor.says('PAST · scan 11')
    editor.element('NC', 'Stop', 'open')
    editor.keys('Escape')
    editor.says('SIMULATION · PAUSE')
    editor.keys('alt+Left', 'alt+Left')
    editor.says('PAST · scan 13')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    until(lambda: not editor.all('PAST'), 'the newest scan')


def why(screen):
    """why a coil is off is answered for the present scan and for a past one"""
    editor = session(screen)
    editor.click(editor.beside(editor.element('COIL', 'Motor')))
    editor.keys('ctrl+F12')
    editor.says('No power: Stop is TRUE')
    editor.shot('chart-why')
    editor.keys(*['alt+Left'] * 11)
    editor.says('PAST · scan 4')
    until(lambda: editor.all('No power: Start is FALSE') or editor.all('No power: Motor is FALSE'), 'another reason')
    editor.keys(*['alt+Right'] * 4)
    editor.says('It has power: ')
    editor.keys('ctrl+F12')
    until(lambda: not editor.all('It has power'), 'no answer')


def edit(screen):
    """a rung added while the program runs is executed; values are kept"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    toggle(editor, 'NO', 'Start', 'open')
    editor.element('COIL', 'Motor', ', on')
    editor.keys('Insert')
    editor.entry('Motor')
    editor.entry('OUT Lamp')
    editor.element('Rung 2, COIL', 'Lamp', ', on')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.says('SIMULATION')
    editor.save(path)
    editor.keys('ctrl+m')
    editor.says('EDIT')
    check(path)


def over_an_edit(screen):
    """a scan before an edit is shown with the rungs of that time, read-only"""
    editor = session(screen)
    toggle(editor, 'NC', 'Stop', 'open')
    editor.keys('Escape', 'Home', 'Delete')  # no Start, no motor: another program
    editor.says('The program was changed after scan 15')
    scans(editor, 5)
    editor.says('scan 20')
    editor.tab('Timing chart')
    chart = editor.find('Timing chart, cursor')
    editor.click(editor.find('Show all recorded scans'))
    x, y, width, _ = editor.place(chart)
    at = lambda scan: (x + NAMES + (width - NAMES) * scan * 10 // 200 + 3, y + 20)
    editor.drag(at(18), at(7), look='chart-older')
    editor.says('PAST · scan 7')
    editor.says('The program before the edit at ')
    editor.element('NO', 'Start', 'closed')
    editor.element('COIL', ', on')
    # The past accepts no edits and no values.
    editor.click(editor.beside(editor.element('NO', 'Start')))
    editor.keys('space')
    editor.says('This page is read-only')
    editor.keys('Delete', 'a')
    editor.element('NO', 'Start', 'closed')
    editor.keys('alt+Right', 'alt+Right', 'alt+Right', 'alt+Right')
    editor.says('PAST · scan 11')
    editor.click(editor.beside(editor.element('COIL', ', off')))
    editor.keys('ctrl+F12')
    editor.says('No power: Stop is TRUE')
    editor.shot('chart-older-why')
    # After the edit the sheet shows the document again.
    editor.keys(*['alt+Right'] * 5)
    editor.says('PAST · scan 16')
    until(lambda: not editor.all('The program before the edit at '), 'the bar to go')
    assert not [node for node in editor.all('NO', 'table cell') if 'Start' in node.name]
    editor.keys(*['alt+Left'] * 2)
    editor.says('The program before the edit at ')
    editor.find('Show the newest scan', 'push button').press()
    editor.says('SIMULATION · PAUSE')
    editor.keys('ctrl+z')
    editor.element('NO', 'Start')


def faults(screen):
    """a program with errors does not start and its first error is shown; an endless loop is a fault with its place"""
    path = new_file(screen, PROGRAM.replace('NO Start', 'NO Nobody'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('Nobody')
    assert not editor.all('SIMULATION'), 'it runs'
    editor.finish()
    path = new_file(screen, PROGRAM.replace('END_PROGRAM', 'RUNG Again\n  | NO Start | JMP Again |\nEND_PROGRAM'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    toggle(editor, 'Rung 1, NO', 'Start', 'open')
    editor.says('SIMULATION · FAULT')
    bar = 'instruction budget of the scan exceeded (a loop?): Main, rung 2, row 1, column '  # also in the status bar
    until(lambda: len(editor.all(bar, 'label')) > 1, 'the bar')
    editor.says('Rung 2')
    editor.shot('chart-fault')
    editor.element('COIL', 'Motor', ', off')
    # Run starts again and fails again: it is reported again, and stays after the bar is closed.
    _, of_the_bar = [node for node in editor.all('Run', 'push button') if node.name == 'Run']
    stands = editor.find('Simulating · 10 ms · scan ').name
    editor.click(of_the_bar)
    until(lambda: editor.find('Simulating · 10 ms · scan ').name != stands, 'another scan')
    editor.says('SIMULATION · FAULT')
    until(lambda: len(editor.all(bar, 'label')) > 1, 'the bar again')
    editor.shot('chart-fault-again')


main([rewind, why, edit, over_an_edit, faults])
