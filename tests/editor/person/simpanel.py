#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""simpanel - the panel of a simulation: switches, push buttons, keys, values, forces."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Chinese, Editor, main, new_file, sh, until, urge  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL; (* the green button *)
  Stop AT %IX0.1 : BOOL;
  电机 AT %QX0.0 : BOOL; (* 主电机 *)
  Level AT %AIW0 : INT;
  Speed AT %AQW2 : INT;
  Wait : TIME := T#1m;
  Overload_of_the_second_motor_behind_the_wall AT %MX0.0 : BOOL;
END_VAR

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG "Motor"
  | NO Start | NC Stop | NC Overload_of_the_second_motor_behind_the_wall | COIL 电机 |
  | NO 电机 ^|
RUNG "Delay"
  | NO 电机 | TON Delay PT:=Wait | COIL %QX0.1 |
RUNG
  | NO Start | MOVE IN:=Level OUT=>Speed |
END_PROGRAM
'''
CHOSEN = '''
VIEW
  panel Start push hold x
  panel Stop toggle F11
  panel Level range 0 100
END_VIEW
'''


def begin(screen, text):
    editor = Editor(screen, new_file(screen, text))
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    return editor


def line(editor, *parts):
    """The line of the panel whose name has all these parts; waits for it."""
    def look():
        found = [node for node in editor.all(parts[0], 'list item') if all(part in node.name for part in parts)]
        return found[0] if found else None
    return until(look, 'the line %s' % ', '.join(parts))


def switch(editor, name, role='check box'):
    return editor.find('Input ' + name, role)


def pointer(screen):
    """switches and a push button by pointer, a value typed, a force from the menu"""
    editor = begin(screen, PROGRAM)
    line(editor, 'Output 电机, %QX0.0, off')
    editor.click(switch(editor, 'Start, %IX0.0'))
    line(editor, 'Input Start, %IX0.0, on')
    line(editor, 'Output 电机, %QX0.0, on')
    editor.click(switch(editor, 'Start, %IX0.0'))
    line(editor, 'Input Start, %IX0.0, off')
    line(editor, 'Output 电机, %QX0.0, on')
    until(lambda: any(not node.name.startswith('0:00') for node in editor.all('/ 1:00 min', 'label')), 'the timer to count')
    editor.shot('simpanel-light')
    editor.click(switch(editor, 'Stop, %IX0.1'))
    line(editor, 'Output 电机, %QX0.0, off')
    editor.click(line(editor, 'Output 电机'), button=3)
    editor.find('Force on', 'menu item').press()
    line(editor, 'Output 电机, %QX0.0, on, forced')
    editor.says('1 force')
    editor.shot('simpanel-forced')
    value = editor.find('/ 1:00 min', 'label')

    # It clicks again if there is none yet: GTK 4.8 under X11 loses some clicks where a popover was, while the window
    # redraws in each frame. The field covers the value that was clicked.
    urge(lambda: editor.asked() or editor.all('Delay, preset', 'text'), lambda: editor.click(value), 'the field of the preset')
    editor.focus_on(role='text')
    editor.keys('ctrl+a')
    editor.type('2m30s')
    editor.keys('Return')
    editor.says('/ 2:30 min')


def keyboard(screen):
    """the same by keyboard, held and bound keys, a filter"""
    editor = begin(screen, PROGRAM + CHOSEN)
    push = switch(editor, 'Start, %IX0.0', 'push button')
    x, y = editor.centre(push)
    sh('xdotool', 'mousemove', str(x), str(y), 'mousedown', '1')
    line(editor, 'Input Start, %IX0.0, on')
    editor.shot('simpanel-held')
    scan = int(re.search(r'scan (\d+)', editor.find('Simulating · ', 'label').name)[1])
    until(lambda: int(re.search(r'scan (\d+)', editor.find('Simulating · ', 'label').name)[1]) > scan + 40, 'scans with the button down')
    line(editor, 'Input Start, %IX0.0, on')
    sh('xdotool', 'mouseup', '1')
    line(editor, 'Input Start, %IX0.0, off')
    sh('xdotool', 'keydown', 'space')
    line(editor, 'Input Start, %IX0.0, on')
    sh('xdotool', 'keyup', 'space')
    line(editor, 'Input Start, %IX0.0, off')
    editor.keys('Down', 'space')
    line(editor, 'Input Stop, %IX0.1, on')
    editor.keys('ctrl+shift+f')
    line(editor, 'Input Stop, %IX0.1, on, forced')
    editor.keys('ctrl+shift+f')
    until(lambda: not editor.all('forced', 'list item'), 'the force to go')
    editor.keys('F11')
    line(editor, 'Input Stop, %IX0.1, off')
    editor.click(editor.sheet())
    sh('xdotool', 'keydown', 'x')
    line(editor, 'Input Start, %IX0.0, on')
    sh('xdotool', 'keyup', 'x')
    line(editor, 'Input Start, %IX0.0, off')
    editor.click(editor.find('Filter the variables'))
    editor.focus_on(role='entry')
    editor.type('x')  # elsewhere it would be a key that holds Start on
    until(lambda: not editor.all('Analogue Level', 'list item'), 'the filter')
    line(editor, 'Input Start, %IX0.0, off')


def unfolded(screen):
    """a timer unfolds to its pins by pointer and by keys; a folded one is found; Left goes back to its line"""
    editor = begin(screen, PROGRAM)
    timer = line(editor, 'Timer Delay', 'folded')
    assert not editor.all('Delay.IN', 'list item')
    x, y, _, height = editor.place(timer)
    editor.click((x + 8, y + height // 2))
    line(editor, 'Delay.IN')
    editor.shot('simpanel-unfolded')
    editor.keys('Down', 'Left')
    until(lambda: line(editor, 'Timer Delay').has(23), 'the line of the timer')
    editor.keys('Left')
    until(lambda: not editor.all('Delay.IN', 'list item'), 'the pins to be folded')
    editor.keys('Right')
    line(editor, 'Delay.IN')
    editor.keys('Left')
    editor.click(editor.find('Filter the variables'))
    editor.focus_on(role='entry')
    editor.type('delay.et')
    line(editor, 'Delay.ET')
    until(lambda: not editor.all('Input Start', 'list item'), 'the filter')


def small(screen):
    """1024 x 700, dark, Chinese: everything is visible and folds"""
    editor = Chinese(screen, new_file(screen, PROGRAM + CHOSEN), ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.to_sheet()
    editor.keys('ctrl+r')
    node = line(editor, 'Start, %IX0.0')
    assert node.name.startswith('输入 Start'), node.name
    left, _, width, _ = editor.place(node)
    assert left + width <= 1024 and width > 200, (left, width)
    editor.click(node)
    editor.shot('simpanel-small')
    editor.click(node, button=3)
    editor.find('Use as a switch', 'menu item')
    editor.shot('simpanel-small-menu')


small.size = '1024x700x24'
pointer.quick = 'editor-gtk/live'
main([pointer, keyboard, unfolded, small])
