#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""live - the sheet while simulating: contacts are pressed, wires are lit, values are forced."""
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Chinese, Editor, main, new_file, until  # noqa: E402

POWER = {'light': '#0F8A4C', 'dark': '#33D17A'}
FORCE = {'light': '#B35C00', 'dark': '#FFA348'}
PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Level : INT;
END_VAR

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG "Motor"
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^|
RUNG "Delay"
  | NO Motor | TON Delay PT:=T#500ms | [ Level > 500 ] | COIL %QX0.1 |
END_PROGRAM
'''


def pixels(editor, node, color):
    """How many pixels of a colour the cell has."""
    x, y, width, height = editor.place(node)
    picture = subprocess.run(['import', '-window', 'root', '-crop', '%dx%d+%d+%d' % (width, height, x, y),
                              '-depth', '8', 'ppm:-'], capture_output=True, check=True).stdout
    rgb = bytes(int(color[i:i + 2], 16) for i in (1, 3, 5))
    body = picture[len(re.match(rb'P6\s+\d+\s+\d+\s+\d+\s', picture)[0]):]
    return sum(body[i:i + 3] == rgb for i in range(0, len(body), 3))


def motor(screen):
    """the motor sample: contacts are pressed with the mouse; coil and wires are lit"""
    path = os.path.join(screen.home, 'motor.rung')
    shutil.copy(os.path.join(ROOT, 'ladders', 'motor.rung'), path)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('shift+F4', 'ctrl+r')  # all rungs must be visible
    editor.says('SIMULATION')
    for name in 'StopOk', 'OverloadOk':
        editor.click(editor.middle(editor.element('Rung 1, NO', name, 'open')))
        editor.element('Rung 1, NO', name, 'closed')
    coil = editor.element('Rung 1, COIL', ', off')
    assert pixels(editor, coil, POWER['light']) == 0
    editor.shot('live-motor-off')
    editor.keys('ctrl+r')  # the contactor must answer within a time too short for a hand
    editor.says('PAUSE')
    editor.click(editor.middle(editor.element('Rung 1, P,', 'Start')))
    editor.says('Start = TRUE')
    editor.keys('ctrl+t')
    coil = editor.element('Rung 1, COIL', ', on')
    assert pixels(editor, coil, POWER['light']) > 150, 'the coil and its wires are not lit'
    editor.click(editor.middle(editor.element('Rung 5, NO', 'Closed')))
    editor.says('Closed = TRUE')
    editor.keys('ctrl+r')
    editor.element('Rung 5, COIL', ', on')
    editor.shot('live-motor-on')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'StopOk')))
    coil = editor.element('Rung 1, COIL', ', off')
    assert pixels(editor, coil, POWER['light']) < 150


def force(screen):
    """a forced value holds against the program, with a mark in the rung and the status bar"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.click(editor.beside(editor.element('Rung 1, NO', 'Start', 'open')))
    editor.keys('space')
    coil = editor.element('Rung 1, COIL', ', on')
    editor.click(editor.beside(coil))
    editor.keys('ctrl+shift+f')
    coil = editor.element('Rung 1, COIL', ', on, forced')
    assert pixels(editor, coil, FORCE['light']) > 60, 'no mark'
    editor.says('1 force')
    editor.keys('space')
    coil = editor.element('Rung 1, COIL', ', off, forced')
    editor.shot('live-forced')
    editor.keys('ctrl+shift+f')
    editor.element('Rung 1, COIL', 'Motor, %QX0.0, on')
    assert not [node for node in editor.all('forced', 'table cell')]


def numbers(screen):
    """a number gets another value at its place; a text that is no value is refused"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    compare = editor.element('Rung 2, [ ]', 'open')
    x, y = editor.middle(compare)
    editor.click((x, y), count=2)
    editor.opened()
    editor.type('99999')
    editor.says('-32768')
    editor.shot('live-set-wrong')
    editor.keys('ctrl+a')
    editor.entry('512')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start')))
    editor.element('Rung 2, [ ]', ', 512 > 500, closed')
    editor.element('Rung 2, TON', ', 500 ms / 500 ms')
    editor.element('Rung 2, COIL', ', on')
    editor.shot('live-numbers')
    before = open(path).read()
    editor.keys('Home', 'shift+F5')  # edited while it runs
    editor.opened()
    editor.entry('Stop')
    # The new program goes on from the values of the old one: Start and Motor are on.
    until(lambda: len([node for node in editor.all('Rung 1, NO', 'table cell')
                       if 'Stop' in node.name and node.name.endswith('open')]) == 1, 'power in the edited rung')
    editor.element('Rung 1, COIL', ', on')
    editor.says('SIMULATION')
    assert not editor.all('SIMULATION · ')
    editor.shot('live-edited')
    assert open(path).read() == before


def dark_and_small(screen):
    """a small dark screen, in Chinese"""
    path = new_file(screen, PROGRAM.replace('Start', '启动').replace('Stop', '停止').replace('Motor', '电机'))
    editor = Chinese(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.to_sheet()
    editor.keys('ctrl+r', 'ctrl+F4')
    start = until(lambda: [node for node in editor.all(role='table cell') if '启动' in node.name], '启动')[0]
    editor.click(editor.middle(start))
    coil = until(lambda: [node for node in editor.all(role='table cell')
                          if 'COIL' in node.name and node.name.endswith('接通')], 'the coil to be on')[0]
    assert pixels(editor, coil, POWER['dark']) > 150
    editor.click(editor.beside(coil))
    editor.keys('ctrl+shift+f')
    until(lambda: [node for node in editor.all(role='table cell') if node.name.endswith('已强制')], 'the mark')
    editor.shot('live-dark-chinese')


def constants(screen):
    """a comparison shows the value of a constant, too, not its name"""
    editor = Editor(screen, new_file(screen, PROGRAM.replace('PROGRAM', """VAR CONSTANT
  Most : INT := 80;
END_VAR

PROGRAM""", 1).replace('Level > 500', 'Level < Most')))
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    until(lambda: [cell for cell in editor.cells() if '0 < 80' in cell], 'both values')


dark_and_small.size = '1024x700x24'
motor.quick = 'editor-gtk/sim'
if __name__ == '__main__':
    main([motor, force, numbers, constants, dark_and_small])
