#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online_views - charts, lists, reasons, a large program: the values of a real ladderd in each view.

The boards are ladderds of this machine, whose lines are simulated.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from charts import at, on_chart, shape, shapes, upon  # noqa: E402
from desk import Editor, main, new_file, until  # noqa: E402
from online import Board, connect, says  # noqa: E402
from online_live import PUMP  # noqa: E402
from spoken import described  # noqa: E402

MAP = 'BOARD "hall"\n%IX0.0 sim\n%QX0.0 sim\n'
CHART = '''RUNGBOARD 1
PROJECT "Filler"

VAR
  Go AT %IX0.0 : BOOL;
  Valve AT %QX0.0 : BOOL;
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
'''
LIST = '''RUNGBOARD 1
PROJECT "Counter"

VAR
  Go AT %IX0.0 : BOOL;
  Lamp AT %QX0.0 : BOOL;
  Level : INT := 30;
  Sum : INT;
END_VAR

PROGRAM Main IL
  LD Level
  ADD 12
  ST Sum
  LD Go
  ST Lamp
END_PROGRAM
'''


def charts(screen):
    """a chart shows the step that is active on the board, and the power in a condition"""
    board = Board(screen, 'charted', program=CHART, board=MAP)
    editor = Editor(screen, new_file(screen, CHART, 'filler.rung'))
    on_chart(editor)
    connect(editor, board.where)
    shape(editor, 'Step Idle, initial, active')
    board.ask('force', 'Go=1')
    shape(editor, 'Step Fill, active')
    until(lambda: 'Step Idle, initial' in shapes(editor), 'Idle to be left')
    editor.shot('online-chart')
    board.ask('force', 'Go=0')
    shape(editor, 'Step Idle, initial, active')
    editor.click(upon(editor, shape(editor, 'from Idle to Fill')))
    at(editor, 'from Idle to Fill')
    editor.keys('ctrl+F12')
    until(lambda: editor.all('Condition: ', 'label'), 'the condition')
    editor.element('Rung 1', 'Go', 'FALSE')
    board.ask('force', 'Go=1')
    editor.element('Rung 1', 'Go', 'TRUE')
    editor.shot('online-chart-condition')
    board.stop()


def lists(screen):
    """each line of a list shows its value and its result on the board; a screen reader reads those of the line"""
    board = Board(screen, 'listed', program=LIST, board=MAP)
    editor = Editor(screen, new_file(screen, LIST, 'counter.rung'))
    text = editor.find('Text of the program')
    connect(editor, board.where)
    says(editor, 'hall · RUN')
    editor.click(text)
    editor.keys('ctrl+Home', 'Down')
    until(lambda: described(editor, text) == 'value 30, result 30', 'the value of the first line')
    editor.keys('Down')
    until(lambda: described(editor, text) == 'result 42', 'the result of the second line')
    board.ask('force', 'Go=1')
    editor.keys('Down', 'Down')
    until(lambda: described(editor, text) == 'value TRUE, result TRUE', 'the force in the list')
    editor.shot('online-list')
    board.stop()


def reasons(screen):
    """why a coil has no power on the board"""
    board = Board(screen, 'reasoned', program=PUMP, board=MAP)
    editor = Editor(screen, new_file(screen, PUMP, 'pump.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    editor.click(editor.beside(editor.element('Rung 1, COIL', ', off')))
    editor.keys('ctrl+F12')
    editor.says('No power: Start is FALSE')
    editor.shot('online-why')
    board.ask('force', 'Start=1')
    editor.element('Rung 1, COIL', ', on')
    editor.says('It has power: ')
    board.stop()


LARGE = 3000


def large(screen):
    """a program with more variables than a board publishes at once: those that are seen have values"""
    program = 'RUNGBOARD 1\nPROJECT "Large"\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n' + ''.join(
        '  Value%d : INT := %d;\n' % (i, i) for i in range(LARGE)) + 'END_VAR\n\nPROGRAM Main LD\n' + ''.join(
        'RUNG\n  | [ Value%d > 20 ] | COIL Lamp |\n' % i for i in range(LARGE)) + 'END_PROGRAM\n'
    board = Board(screen, 'large', program=program, board=MAP)
    editor = Editor(screen, new_file(screen, program, 'large.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    editor.element('Rung 2, [ ]', '1 > 20, open')
    editor.to_sheet()
    editor.keys('ctrl+End')
    editor.element('Rung %d, [ ]' % LARGE, '%d > 20, closed' % (LARGE - 1))
    editor.shot('online-large')
    board.ask('set', 'Value%d=7' % (LARGE - 1))
    editor.element('Rung %d, [ ]' % LARGE, '7 > 20, open')
    assert not editor.all('more than the board can take'), 'the values were asked for too early'
    editor.keys('ctrl+Home')
    editor.element('Rung 2, [ ]', '1 > 20, open')
    board.stop()


if __name__ == '__main__':
    main([charts, lists, reasons, large])
