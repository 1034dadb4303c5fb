#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online_live - a person watches a real ladderd in the sheets, forces and writes, and edits beside it.

The boards are ladderds of this machine, whose lines are simulated.
"""
import os
import signal
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from charts import at, on_chart, shape, shapes, typed, upon  # noqa: E402
from desk import Chinese, Editor, main, new_file, until  # noqa: E402
from online import Board, connect, says  # noqa: E402
from spoken import described  # noqa: E402

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


def cell(editor, text):
    return until(lambda: [node for node in editor.all(role='table cell') if text in node.name], text)[0]


def other_language(screen):
    """the ladder as networks: also the results that no variable has, of values that the board sends for them"""
    board = board_of(screen, 'shown')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    editor.keys('ctrl+1')
    cell(editor, '>, output 1: wire, TRUE')
    cell(editor, 'TON Soft, output Q: open, TRUE')
    cell(editor, 'Store in Motor, FALSE')
    editor.shot('online-networks')
    board.ask('set', 'Level=7')
    cell(editor, '>, output 1: wire, FALSE')
    board.ask('force', 'Start=1')
    cell(editor, 'Store in Motor, input 1: Start, TRUE')
    editor.finish()


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


CHART = '''RUNGBOARD 1
PROJECT "Filler"

VAR
  Go AT %IX0.0 : BOOL;
  Valve AT %QX0.0 : BOOL;
  Count : INT;
END_VAR

PROGRAM Main SFC
  INITIAL_STEP Idle:
  END_STEP

  TRANSITION FROM Idle TO Fill := Go; END_TRANSITION

  STEP Fill:
    Valve(N);
  END_STEP

  TRANSITION FROM Fill TO Idle := NOT Go; END_TRANSITION
END_PROGRAM

PROGRAM Second IL
  LD    Go
  ST    %MX1.0
END_PROGRAM
'''


def edits_elsewhere(screen):
    """edited lines, steps, transitions and symbols are marked, too, and their rows in the tree, until they are undone"""
    board = board_of(screen, 'elsewhere', program=CHART)
    editor = Editor(screen, new_file(screen, CHART, 'filler.rung'))
    on_chart(editor)
    connect(editor, board.where)
    shape(editor, 'Step Idle, initial, active')
    assert not editor.all('not downloaded'), [node.name for node in editor.all('not downloaded')]
    editor.click(upon(editor, shape(editor, 'from Fill to Idle')))
    at(editor, 'from Fill to Idle')
    typed(editor, 'Valve')
    shape(editor, 'from Fill to Idle', 'not downloaded')
    editor.find('Main, 2 steps, not downloaded')
    assert not [name for name in shapes(editor) if name.startswith('Step') and 'not downloaded' in name], shapes(editor)
    editor.shot('online-chart-edited')
    editor.keys('ctrl+z')
    until(lambda: not editor.all('not downloaded'), 'the marks to go')
    editor.click(editor.find('Second, IL'), count=2)
    text = editor.find('Text of the program')
    until(lambda: text.has(12), 'the focus in the list')
    editor.keys('ctrl+Home', 'Down', 'End', 'Return')
    editor.type('AND Valve')
    editor.find('Second, IL, not downloaded')
    until(lambda: described(editor, text) == 'not downloaded', 'the mark of the line')
    editor.shot('online-list-edited')
    editor.keys('Up')
    until(lambda: described(editor, text) == 'value FALSE, result FALSE', 'the line above')
    board.stop()


SHOWER = """RUNGBOARD 1
PROJECT "Shower"

TYPE
  Phase : (Idle, Hot, Cold);
END_TYPE

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Level : INT := 30;
  Now : Phase;
END_VAR

PROGRAM Main ST
VAR
  Soft : TON;
END_VAR
  Soft(IN := Start, PT := T#300ms);
  IF Start AND Level > 20 THEN
    Now := Hot;
  ELSE
    Now := Cold;
  END_IF;
  Motor := Soft.Q;
END_PROGRAM
"""


def structured_text(screen):
    """values, results and lines that did not run stand beside Structured Text; an edited line is marked until it is downloaded"""
    board = board_of(screen, 'shower', program=SHOWER)
    path = new_file(screen, SHOWER, 'shower.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path)
    view = editor.find('Text of the program')
    editor.into('Text of the program')
    connect(editor, board.where)
    editor.says('ONLINE')
    until(lambda: view.has(12), 'the focus in the text again')

    def on(line, wanted):
        editor.keys('ctrl+Home', *['Down'] * (line - 1))
        until(lambda: described(editor, view) == wanted, 'line %d to have %s' % (line, wanted))
    on(5, 'value 0 ms / 300 ms')
    on(6, 'value FALSE · 30, result FALSE')
    on(7, 'value Cold, result not run')
    on(9, 'value Cold, result Cold')
    editor.shot('online-st')
    board.ask('force', 'Start=1')
    on(9, 'value Hot, result not run')
    on(7, 'value Hot, result Hot')
    on(11, 'value TRUE · TRUE, result TRUE')
    board.ask('set', 'Level=7')
    on(6, 'value TRUE · 7, result FALSE')
    editor.keys('End', *['Left'] * len(' THEN'))
    editor.type('0')  # 20 is 200 now
    until(lambda: 'Level > 200 THEN' in view.text(), 'what was typed')
    on(6, 'not downloaded')
    on(9, 'value Cold, result Cold')
    editor.shot('online-st-edited')
    board.ask('set', 'Level=100')
    on(7, 'value Hot, result Hot')
    editor.keys('ctrl+shift+l')
    editor.find('Download to “pump house”?', 'label')
    editor.keys('Return')
    says(editor, 'The board runs this program.')
    until(lambda: view.has(12), 'the focus in the text again')
    on(6, 'value TRUE · 100, result FALSE')
    on(7, 'value Cold, result not run')
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


def operates(screen):
    """what the board itself refuses is said where a person did it: at the element, in the status chart, in the panel"""
    board = board_of(screen, 'operated', role='oper')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    why = 'may be written only with the role eng'
    editor.click(editor.middle(editor.element('Rung 2, [ ]', '30 > 20')), count=2)
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('7')
    editor.keys('Return')
    until(lambda: [node for node in editor.all(why, 'label') if '"Level"' in node.name], 'the refusal')
    until(lambda: editor.asked(), 'the refusal at the element')
    editor.shot('online-refused-sheet')
    editor.keys('Escape')
    editor.gone()
    log = editor.logs('communication', '"Level" ' + why)
    assert log.count('"Level" ' + why) == 1, log
    editor.tab('Status chart')
    editor.into('Level, New value')
    editor.type('5')
    editor.keys('Return')
    entry = editor.find('Level, New value', 'text')
    until(lambda: described(editor, entry) == '"Level" ' + why + ': it does not stand in VAR_ACCESS of the program', 'the reason at the entry')
    until(lambda: entry.text() == '5', 'what was typed')
    editor.shot('online-refused-board')
    editor.click(editor.find('Motor, Force'))
    until(lambda: 'ladder-eng' in described(editor, editor.find('Motor, Force')), 'the reason at the force')
    editor.click(editor.find('Input Start, %IX0.0', 'check box'))
    line = until(lambda: [node for node in editor.all('Input Start', 'list item')], 'the line')[0]
    until(lambda: editor.all('"Start" ' + why, 'label', line.path), 'the reason in the panel')
    editor.shot('online-refused-panel')
    assert '30' in board.ask('get', 'Level')
    board.stop()


def late(screen):
    """a view says how late it is while its board does not answer"""
    board = board_of(screen, 'late')
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    begin(screen, board, editor)
    editor.says('ONLINE')
    assert not editor.all(' late'), 'it is not late'
    board.daemon.send_signal(signal.SIGSTOP)
    editor.find(' s late', 'label')
    editor.shot('online-late')
    board.daemon.send_signal(signal.SIGCONT)
    until(lambda: not editor.all(' late'), 'the values to be new again')
    editor.element('Rung 2, [ ]', '30 > 20, closed')
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


NETWORKS = '''RUNGBOARD 1
PROJECT "Tank"

VAR
  Ready AT %IX0.0 : BOOL;
  Valve AT %QX0.0 : BOOL;
  Level : INT := 30;
  Limit : INT;
  Delay : TON;
END_VAR

PROGRAM Main FBD
NETWORK "Open while there is room"
  Room := Level < 50
  Delay(IN := Room AND Ready, PT := T#20ms)
  Valve := Delay.Q
NETWORK "Half of the sum"
  Limit := (Level + 6) / 2
END_PROGRAM
'''


def networks(screen):
    """values of pins and wires are those of the board; what a board keeps nowhere is computed of them; why an output is FALSE"""
    board = board_of(screen, 'tank', program=NETWORKS)
    editor = Editor(screen, new_file(screen, NETWORKS, 'tank.rung'))
    until(lambda: editor.all('Networks'), 'the sheet')
    connect(editor, board.where)

    def part(name):
        return until(lambda: [node for node in editor.all(role='table cell') if node.name == name], 'what is called ' + name)[0]
    part('<, input 1: Level, 30')
    part('<, output 1: wire Room, TRUE')
    part('Store in Valve, FALSE')
    part('/, input 1: wire, 36')
    part('+, output 1: wire, 36')
    part('Store in Limit, 18')
    editor.click(part('Store in Valve, FALSE'))
    editor.keys('ctrl+F12')
    until(lambda: editor.all('Delay.IN FALSE: Ready is FALSE'), 'why the valve is shut')
    board.ask('force', 'Ready=1')
    part('Store in Valve, TRUE')
    editor.shot('online-networks')
    board.ask('set', 'Level=60')
    part('<, input 1: Level, 60')
    part('<, output 1: wire Room, FALSE')
    part('Store in Valve, FALSE')
    part('Store in Limit, 33')
    part('/, input 1: wire, 66')
    board.stop()


chinese.size = '1024x700x24'

if __name__ == '__main__':
    main([watches, other_language, edits, edits_elsewhere, structured_text, only_looks, operates, late, recording, networks, chinese])
