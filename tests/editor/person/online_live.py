#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online_live - a person watches a real ladderd in the sheets, forces and writes, and edits beside it.

The boards are ladderds of this machine, whose lines are simulated.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Chinese, Editor, main, new_file, until  # noqa: E402
from online import Board, connect, says  # noqa: E402

PUMP = '''RUNGBOARD 1
PROJECT "Pump"

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Level : INT := 30;
  Soft : TON;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
RUNG
  | [ Level > 20 ] | TON Soft PT:=T#500ms |
END_PROGRAM
VIEW
  status-chart Chart 1
    watch auto Motor
    watch auto Level
END_VIEW
'''
MAP = 'BOARD "pump house"\n%IX0.0 sim\n%QX0.0 sim\n'


def board_of(screen, name, role='eng', program=PUMP):
    return Board(screen, name, program=program, role=role, board=MAP)


def begin(screen, board, editor):
    editor.to_sheet()
    connect(editor, board.where)
    editor.element('Rung 1, NO', 'Start', 'open')
    editor.to_sheet()


def watches(screen):
    """power flows as on the board; a force from the sheet is on the board; its end and another one's are shown"""
    board = board_of(screen, 'watched')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    editor.says('ONLINE')
    editor.element('Rung 1, COIL', ', off')
    editor.element('Rung 2, [ ]', '30 > 20, closed')
    editor.element('Rung 2, TON', '500 ms / 500 ms')
    board.ask('force', 'Start=1')
    editor.element('Rung 1, COIL', ', on')
    editor.find('1 force', 'push button')
    editor.shot('online-live')
    board.ask('unforce', 'Start')
    editor.element('Rung 1, COIL', ', off')
    editor.click(editor.beside(editor.element('Rung 1, COIL', ', off')))
    editor.keys('ctrl+shift+f')
    editor.element('Rung 1, COIL', ', off, forced')
    editor.keys('space')
    editor.element('Rung 1, COIL', ', on, forced')
    assert 'Motor' in board.ask('forces')
    editor.keys('ctrl+shift+f')
    until(lambda: not editor.all('forced', 'table cell'), 'the force to end')
    board.ask('set', 'Level=7')
    editor.element('Rung 2, [ ]', '7 > 20, open')
    board.stop()
    until(lambda: not editor.all('7 > 20', 'table cell'), 'values of a board that has gone to go')
    board.start()
    editor.element('Rung 2, [ ]', '30 > 20, closed')
    board.stop()


def edits(screen):
    """an edited rung is marked until it is undone; others show the power of the board"""
    board = board_of(screen, 'edited')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    editor.click(editor.beside(editor.element('Rung 1, NO', 'Start')))
    editor.keys('shift+F5')
    editor.opened()
    editor.entry('Motor')
    editor.element('Rung 1, NO', 'Motor', 'not downloaded')
    board.ask('force', 'Start=1')
    editor.element('Rung 2, [ ]', '30 > 20, closed')
    assert not editor.all('Rung 2, [ ], not downloaded', 'table cell')
    editor.shot('online-edited')
    editor.keys('ctrl+z')
    editor.element('Rung 1, COIL', ', on')
    until(lambda: not editor.all('not downloaded', 'table cell'), 'the mark to go')
    board.stop()


def only_looks(screen):
    """a role that only looks: the entry says so, and nothing happens on the board"""
    board = board_of(screen, 'looked', role='view')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    editor.click(editor.beside(editor.element('Rung 1, COIL', ', off')))
    editor.keys('ctrl+shift+f')
    editor.says('ladder-eng')
    editor.shot('online-refused')
    editor.keys('Escape')
    editor.tab('Status chart')
    editor.into('Level, New value')
    editor.type('5')
    editor.keys('Return')
    editor.find('This needs the role “oper” on the board', 'label')
    editor.shot('online-refused-chart')
    editor.element('Rung 1, COIL', ', off')
    assert 'Level' in board.ask('get', 'Level') and '30' in board.ask('get', 'Level')
    board.stop()


def recording(screen):
    """a recording of a board is opened: its scans are shown without the board"""
    board = board_of(screen, 'recorded')
    board.ask('force', 'Start=1')
    until(lambda: '1' in board.ask('get', 'Motor'), 'the motor')
    path = os.path.join(screen.home, 'pump.rec')
    board.ask('record', '-o', path)
    board.stop()
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    editor.to_sheet()
    editor.give_path(path, lambda: editor.command('Open recording'), 'Recording of a board')
    editor.says('RECORDING')
    editor.element('Rung 1, COIL', ', on')
    editor.to_sheet()
    editor.keys('alt+Left')
    editor.says('PAST · scan')
    editor.shot('online-recording')
    editor.click([node for node in editor.all('Edit') if node.name == 'Edit'][0])
    editor.says('EDIT')


def chinese(screen):
    """a small dark screen, in Chinese"""
    board = board_of(screen, 'chinese')
    editor = Chinese(screen, new_file(screen, PUMP, 'pump.rung'), ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.to_sheet()
    connect(editor, board.where)
    until(lambda: [node for node in editor.all(role='table cell') if '30 > 20' in node.name], 'values')
    board.ask('force', 'Start=1')
    until(lambda: [node for node in editor.all(role='table cell') if 'COIL' in node.name and node.name.endswith('接通')], 'the coil')
    editor.shot('online-chinese')
    board.stop()


chinese.size = '1024x700x24'

if __name__ == '__main__':
    main([watches, edits, only_looks, recording, chinese])
