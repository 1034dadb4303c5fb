#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""scenario - a person records a scenario, saves it, runs all scenarios, and goes to the place of a failure."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import LADDER, Chinese, Editor, main, new_file, sh, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^|
END_PROGRAM
'''
BAD = '''scenario "starts"
  at 20ms  Start = 1
  expect Motor

scenario "starts by itself"
  at 50ms  expect Motor = 1
'''
UNKNOWN = '''scenario "of another machine"
  at 20ms  Strat = 1
  expect Motor
'''


def test(path):
    done = subprocess.run([LADDER, 'test', path], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def text_of(path):
    return open(path).read() if os.path.exists(path) else ''


def row(editor, name):
    """A row of the list of scenarios, by its text."""
    return editor.find(name, 'label')


def records(screen):
    """Record, click contacts, expect a coil, Save: the scenario passes"""
    path = new_file(screen, PROGRAM, 'motor.rung')
    kept = '# By hand.\nscenario "kept"\n  expect not Motor'
    scn = new_file(screen, kept, 'motor.scn')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+alt+r')
    editor.find('Recording · 0 set', 'push button')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start')))
    editor.find('Recording · 1 set', 'push button')
    editor.element('Rung 1, COIL', ', on')
    editor.click(editor.beside(editor.element('Rung 1, COIL')))
    editor.keys('ctrl+alt+e')
    editor.says('Expected: Motor = 1')
    editor.shot('scenario-recording')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start')))
    editor.find('Recording · 2 set', 'push button')
    editor.click(editor.middle(editor.element('Rung 1, NC', 'Stop')))
    editor.find('Recording · 3 set', 'push button')
    editor.click(editor.beside(editor.element('Rung 1, COIL')))
    editor.element('Rung 1, COIL', ', off')
    editor.keys('ctrl+alt+e')
    editor.says('Expected: Motor = 0')
    editor.keys('ctrl+alt+r')
    editor.find('Name of the scenario', 'text')
    editor.type('stop wins')
    editor.shot('scenario-save')
    editor.keys('Return')
    text = until(lambda: 'stop wins' in text_of(scn) and text_of(scn), 'the scenario in the file')
    assert text.startswith(kept + '\n\nscenario "stop wins"\n  period '), text
    assert 'Start = 1' in text and 'expect Motor = 1' in text and 'Stop = 1' in text, text
    status, said = test(scn)
    assert status == 0, said
    editor.find('2 passed', 'label')
    editor.shot('scenario-passed')


def rests(screen):
    """the safe value that an output has in STOP is no value of the program: "expect" is refused with the reason"""
    path = new_file(screen, PROGRAM.replace('END_PROGRAM', 'RUNG\n  | NO Stop | STOP |\nEND_PROGRAM'), 'motor.rung')
    with open(path.replace('.rung', '.io'), 'w') as file:
        file.write('BOARD "Desk"\n%QX0.0 sim safe=1\n')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+alt+r')
    editor.find('Recording · 0 set', 'push button')
    editor.click(editor.middle(editor.element('Rung 2, NO', 'Stop')))
    editor.says('SIMULATION · STOP')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.click(editor.beside(editor.element('Rung 1, COIL')))
    editor.keys('ctrl+alt+e')
    editor.says('"Motor" has its safe value in STOP')
    editor.shot('scenario-rests')


def long_names(screen):
    """a name is whole where the list has room for it; in a narrow window it ends in an ellipsis, and the result has room"""
    path = new_file(screen, PROGRAM, 'motor.rung')
    name = 'The motor starts by itself at once, and nobody knows who built it so'
    new_file(screen, BAD.replace('starts by itself', name), 'motor.scn')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+F5')
    editor.tab('Scenarios')

    def width(window):
        sh('xdotool', 'windowsize', '--sync', editor.window, str(window), '700')
        until(lambda: editor.place()[2] <= window, 'that window')
        return [until(lambda: row(editor, text), text).box()[2] for text in (name, 'failed: at 50 ms')]
    until(lambda: width(1400)[0] >= 400, 'the whole name')
    editor.shot('scenario-long')
    until(lambda: 100 < width(900)[0] < 300 and width(900)[1] > 150, 'room for the result')


def fails(screen):
    """Run all: one fails, one was recorded on another machine; each opens at its line and scan"""
    path = new_file(screen, PROGRAM, 'motor.rung')
    new_file(screen, BAD, 'motor.scn')
    editor = Editor(screen, path)
    editor.tab('Scenarios')
    editor.find('Not run yet: motor.scn', 'label')
    editor.tab('Problems')
    new_file(screen, UNKNOWN, 'motor-other.scn')
    editor.tab('Scenarios')
    editor.find('Not run yet: motor-other.scn, motor.scn', 'label')
    editor.to_sheet()
    editor.keys('ctrl+F5')
    editor.find('2 of 3 failed', 'label')
    editor.shot('scenario-list')
    editor.click(row(editor, 'starts by itself'), count=2)
    editor.find('SIMULATION · PAUSE', 'label')
    editor.says('at 50 ms: not true: at 50ms  expect Motor = 1')
    editor.says('scan 5')
    editor.shot('scenario-failed')
    editor.click(row(editor, 'is not declared'), count=2)
    editor.find('motor-other.scn', 'text')

    def told():
        return len(editor.all('"Strat" is not declared', 'label'))
    until(lambda: told() == 2, 'the message in the list and, with the cursor in its line, above the text')
    editor.shot('scenario-unknown')
    editor.keys('ctrl+Home')
    until(lambda: told() == 1, 'the message above the text to go with the line')


def chinese(screen):
    """the list and the question at the end of a recording: Chinese, dark, small"""
    path = new_file(screen, PROGRAM, 'motor.rung')
    scn = new_file(screen, BAD, 'motor.scn')
    editor = Chinese(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.to_sheet()
    editor.keys('ctrl+F5')
    until(lambda: editor.all('starts by itself'), 'the list')
    editor.says('50 ms 时：不成立：at 50ms  expect Motor = 1')
    editor.keys('ctrl+alt+r')
    until(lambda: editor.all('\u25cf', 'push button'), 'the recording')
    editor.shot('scenario-chinese')
    editor.keys('ctrl+alt+r')
    until(lambda: editor.all(role='dialog'), 'the question')
    editor.type('by hand')
    editor.shot('scenario-chinese-save')
    editor.keys('Return')
    until(lambda: 'expect Motor = 0' in text_of(scn), 'what all outputs were at the end')


chinese.size = '1024x700x24'
main([records, rests, long_names, fails, chinese])
