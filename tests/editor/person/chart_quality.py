#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chart_quality - values that are not good, in the past: the timing chart hatches the time, the panel marks the scan.

In a simulation the inputs of the driver quality say it; a board has recorded it.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Chinese, Editor, main, new_file, until  # noqa: E402
from node import A11Y  # noqa: E402
from online import Board  # noqa: E402
import client  # noqa: E402  of tests/online, whose folder online.py adds

PROGRAM = '''RUNGBOARD 1

VAR
  Level AT %IW0    : INT;
  Full  AT %IX10.0 : BOOL;
  Good  AT %IX20.0 : BOOL;
  How   AT %IB21   : USINT;
  Motor AT %QX0.0  : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Good | [ Level < 20 ] | COIL Motor |
RUNG
  | NO Full | [ How <> 0 ] | COIL %QX0.1 |
END_PROGRAM

VIEW
  timing Level
  timing Full
  timing Motor
END_VIEW
'''
MAP = '''BOARD "plant"
BUS m    modbus-tcp host=127.0.0.1:9
%IW0     modbus bus=m unit=1 input-register=0 stale=400ms substitute=77
%IX10.0  modbus bus=m unit=1 discrete-input=0 stale=600s
%IX20.0  quality of=%IW0
%IB21    quality of=%IX10.0
%QX0.0   sim safe=0
%QX0.1   sim safe=0
'''
LEVEL, FULL = 0, 1
NAMES = 210  # px of the names at the left of the chart


def scans(editor, count):
    for _ in range(count):
        editor.keys('ctrl+t')


def files(screen):
    path = new_file(screen, PROGRAM, 'plant.rung')
    with open(os.path.join(screen.home, 'plant.io'), 'w') as out:
        out.write(MAP)
    return path


def chart_of(editor):
    editor.tab('Timing chart')
    chart = editor.find('Timing chart, cursor')
    editor.click(editor.find('Show all recorded scans'))
    return chart


def told(chart):
    """What a screen reader says of the chart beside its name."""
    return str(chart.editor.ask([(chart.path, 'Properties', 'Get', 'ss', A11Y + 'Accessible', 'Description')],
                                'org.freedesktop.DBus.')[0][0])


def toggle(editor, *parts):
    editor.click(editor.beside(editor.element(*parts)))
    editor.keys('space')


def in_sheet(editor, name, word):
    """Does the element of this value say the word?"""
    return any(name in cell and cell.endswith(', ' + word) for cell in editor.cells())


def session(screen):
    """Five scans, in which Level is stale; five in which all is good; five more with Level stale again."""
    editor = Editor(screen, files(screen))
    editor.to_sheet()
    scans(editor, 5)
    toggle(editor, 'NO', 'Good')
    scans(editor, 5)
    toggle(editor, 'NO', 'Good')
    scans(editor, 5)
    return editor


def simulated(screen):
    """a simulation: an input of the driver quality makes the value bad that it is about, also in the past"""
    editor = session(screen)
    editor.says('scan 15')
    editor.find('Level, %IW0, stale')
    assert not editor.all('Full, %IX10.0, off, fault')
    until(lambda: in_sheet(editor, 'Level < 20', 'stale'), 'the element of the ladder to say it')
    assert not in_sheet(editor, 'Full', 'stale') and not in_sheet(editor, 'Full', 'fault')
    chart = chart_of(editor)
    x, y, width, _height = editor.place(chart)
    at = lambda scan: (x + NAMES + (width - NAMES) * scan * 10 // 150 + 3, y + 20)
    editor.hover(at(3))
    editor.shot('quality-chart')
    editor.drag(at(3), at(7))
    editor.says('PAST · scan 7')
    until(lambda: not editor.all('Level, %IW0, stale'), 'the value to be good')
    until(lambda: not in_sheet(editor, 'Level < 20', 'stale'), 'the element, too')
    editor.keys('Left', 'Left', 'Left')
    editor.says('PAST · scan 4')
    editor.find('Level, %IW0, stale')
    until(lambda: told(chart) == 'Level: stale', 'what a screen reader says')
    editor.shot('quality-past')
    editor.keys('Right', 'Right', 'Right')
    until(lambda: not told(chart), 'the words to go')


def forced(screen):
    """a value that a person holds: the chart has a mark of its own for that time"""
    editor = Editor(screen, files(screen))
    editor.to_sheet()
    scans(editor, 5)
    toggle(editor, 'NO', 'Good')
    editor.click(editor.beside(editor.element('NO', 'Full')))
    editor.keys('ctrl+shift+f')
    editor.find('Full, %IX10.0, off, forced')
    scans(editor, 5)
    editor.keys('ctrl+shift+f')
    until(lambda: not editor.all('Full, %IX10.0, off, forced'), 'the force to end')
    scans(editor, 5)
    editor.says('scan 15')
    chart = chart_of(editor)
    x, y, width, _height = editor.place(chart)
    at = lambda scan: (x + NAMES + (width - NAMES) * scan * 10 // 150 + 3, y + 60)
    editor.drag(at(4), at(8))
    editor.says('PAST · scan 8')
    until(lambda: told(chart) == 'Full: forced', 'what a screen reader says')
    editor.hover(at(7))
    editor.shot('quality-forced')
    editor.click(at(13))
    editor.says('PAST · scan 13')
    until(lambda: not told(chart), 'the words to go')


NETWORK = PROGRAM[:PROGRAM.index('PROGRAM Main LD')] + '''PROGRAM Main FBD
NETWORK
  Motor := AND(Good, Full, LT(IN1 := Level, IN2 := 20))
END_PROGRAM
'''


def network(screen):
    """a network: its places have the same marks, and say them"""
    path = new_file(screen, NETWORK, 'plant.rung')
    with open(os.path.join(screen.home, 'plant.io'), 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path)
    part = lambda name: until(lambda: [node for node in editor.all(role='table cell') if node.name == name], name)
    part('LT, input IN1: Level')
    scans(editor, 3)
    part('LT, input IN1: Level, 0, stale')
    editor.click(part('AND, input IN2: Full, FALSE')[0])
    editor.keys('ctrl+shift+f')
    scans(editor, 1)
    part('AND, input IN2: Full, TRUE')
    editor.shot('quality-network')
    toggle_good = [node for node in editor.all('Good', 'check box') if node.box()[2] > 0][0]
    editor.click(toggle_good)
    scans(editor, 1)
    part('LT, input IN1: Level, 0')


def recorded(screen):
    """a board: what was not good is marked in what it sent, in its record, and in the file of that"""
    board = Board(screen, 'plant', program=PROGRAM, board=MAP, role='eng io')
    path = files(screen)
    gateway = client.as_gateway(board.folder + '/link', 'modbus')
    gateway.io_put((LEVEL, client.INT, 12), (FULL, client.BOOL, True))
    until(lambda: 'Level=12\n' in board.ask('get', 'Level'), 'the value')
    for _ in range(3):
        gateway.io_put((FULL, client.BOOL, None))
    until(lambda: 'fault' in board.ask('get', 'Full'), 'the fault')
    until(lambda: 'stale' in board.ask('get', 'Level'), 'the value to be stale')
    gateway.io_put((LEVEL, client.INT, 15), (FULL, client.BOOL, False))
    until(lambda: board.ask('get', 'Level', 'Full') == 'Level=15\nFull=0\n', 'all to be good')
    board.ask('force', 'Full=1')
    until(lambda: board.ask('get', 'Full') == 'Full=1 forced\n', 'the force')
    file = os.path.join(screen.home, 'plant.record')
    board.ask('record', '-o', file)
    board.stop()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.give_path(file, lambda: editor.command('Open recording'), 'Recording of a board')
    editor.says('RECORDING')
    chart = chart_of(editor)
    editor.click(chart)
    editor.keys('Home')
    editor.says('PAST · scan 1')
    editor.find('Level, %IW0, stale')
    until(lambda: told(chart) == 'Level: stale, Full: stale', 'two values that are not good')
    editor.shot('quality-record')
    editor.keys('End')
    until(lambda: 'Full: forced' in told(chart), 'what somebody held when the record ended')


def chinese(screen):
    """a dark desk in Chinese: the chart and what is said of it"""
    editor = Chinese(screen, files(screen), ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.to_sheet()
    scans(editor, 5)
    editor.tab(editor.said.gettext('Timing chart'))
    chart = editor.find('Timing chart, cursor')
    editor.click(editor.find('Show all recorded scans'))
    stale = editor.said.gettext('⚠ stale').split(' ')[1]
    until(lambda: told(chart) == editor.said.gettext('%s: %s') % ('Level', stale), 'what a screen reader says')
    editor.shot('quality-dark')


if __name__ == '__main__':
    main([simulated, forced, network, recorded, chinese])
