#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""breakpoints - the simulation stands before a line of Structured Text, and goes on step by step."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, Chinese, Editor, main, new_file, until  # noqa: E402

PLANT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Valve AT %QX0.0 : BOOL;
  Sum   : INT;
END_VAR

FUNCTION_BLOCK Fill ST
VAR_INPUT
  Step : INT;
END_VAR
VAR_OUTPUT
  Level : INT;
END_VAR
  Level := Level + Step;
  IF Level > 100 THEN
    Level := 0;
  END_IF;
END_FUNCTION_BLOCK

PROGRAM Main ST
VAR
  A : Fill;
  B : Fill;
  n : INT;
END_VAR
  Valve := NOT Valve;
  n := n + 1;
  A(Step := 1);
  B(Step := 30);
  Sum := A.Level + B.Level;
END_PROGRAM
'''


def said_of(view):
    """What a screen reader adds to the name of the text."""
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def text_of(editor, heading):
    """The text in front, which begins with that heading and has the keys."""
    def look():
        found = [n for n in editor.all('Text of the program') if n.has(12) and n.text().startswith(heading)]
        return found[0] if found else None
    return until(look, 'the text of ' + heading)


def opened(screen, text=PLANT, kind=Editor, **env):
    """An editor in simulation, and the text of Main, which has the keys."""
    path = new_file(screen, text)
    editor = kind(screen, path, **env)
    editor.click(editor.find('Main, ST'), count=2)
    view = text_of(editor, 'PROGRAM Main')
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    return editor, path, view


def to_line(editor, line):
    """Moves the cursor to the begin of line @line, from 1."""
    editor.keys('ctrl+Home', *['Down'] * (line - 1))
    editor.says('Line %d · column 1' % line)


def stands(editor, where):
    """The bar says that it stands there."""
    until(lambda: editor.all('Step over', 'push button') and editor.all('Stands before ' + where, 'label'), 'the bar: ' + where)


def goes_on(editor):
    until(lambda: not editor.all('Step over', 'push button'), 'no bar')


def stepped(screen):
    """F9 sets a breakpoint, the scan stands there and outputs wait; F8, F7, Shift+F8, F6 and F5 go on; the bar names line, instance and callers; values are those of now"""
    editor, path, view = opened(screen)
    to_line(editor, 8)
    editor.keys('F9')
    stands(editor, 'line 8 of Main')
    until(lambda: 'the program stands before this line' in said_of(view), 'the line that stands')
    editor.says('PAUSE')
    editor.find('Valve', 'label')
    editor.shot('breakpoints-stands')
    editor.keys('F8')
    stands(editor, 'line 9 of Main')
    editor.keys('F7')
    stands(editor, 'line 8 of Fill (instance A), called from line 9 of Main')
    fill = text_of(editor, 'FUNCTION_BLOCK Fill')
    editor.shot('breakpoints-into')
    editor.keys('F8')
    stands(editor, 'line 9 of Fill (instance A)')
    editor.keys('Up')
    until(lambda: re.search('value [0-9]+ · 1', said_of(fill)), 'the values of now')
    editor.keys('shift+F8')
    stands(editor, 'line 10 of Main')
    text_of(editor, 'PROGRAM Main')
    editor.keys('Down', 'F6')
    stands(editor, 'line 11 of Main')
    editor.keys('F5')
    stands(editor, 'line 8 of Main')
    editor.keys('F9')
    until(lambda: 'breakpoint' not in said_of(view), 'no breakpoint')
    editor.keys('F5')
    goes_on(editor)


def by_pointer(screen):
    """a press beside a line sets and clears a breakpoint; the buttons of the bar go on; callers lead to their lines"""
    editor, path, view = opened(screen)
    editor.click(editor.find('Fill, ST'), count=2)
    fill = text_of(editor, 'FUNCTION_BLOCK Fill')
    to_line(editor, 8)
    editor.keys('F9')
    stands(editor, 'line 8 of Fill (instance A), called from line 9 of Main')
    until(lambda: re.search('value [0-9]+ · 1\\b', said_of(fill)), 'the values of A')
    editor.click(editor.find('Continue', 'push button'))
    stands(editor, 'line 8 of Fill (instance B), called from line 10 of Main')
    until(lambda: re.search('value [0-9]+ · 30\\b', said_of(fill)), 'the values of B')
    editor.click(editor.find('Callers'))
    row = editor.find('line 10 of Main', 'push button')
    editor.shot('breakpoints-callers')
    editor.click(row)
    text_of(editor, 'PROGRAM Main')
    editor.says('Line 10 ·')
    editor.shot('breakpoints-caller')
    editor.click(editor.find('Step out', 'push button'))
    stands(editor, 'line 11 of Main')


def conditional(screen):
    """Shift+F9 asks for a condition; a wrong one is told at its place; it stands in the instance for which it is TRUE"""
    editor, path, view = opened(screen)
    editor.click(editor.find('Fill, ST'), count=2)
    fill = text_of(editor, 'FUNCTION_BLOCK Fill')
    to_line(editor, 9)
    editor.keys('shift+F9')
    editor.focus_on('Condition of the breakpoint')
    editor.type('Levl > 50')
    editor.keys('Return')
    until(lambda: editor.all('“Levl”', 'label') or editor.all('"Levl"', 'label'), 'the mistake')
    editor.shot('breakpoints-wrong')
    editor.keys('ctrl+a')
    editor.type('Level > 50')
    editor.keys('Return')
    until(lambda: 'breakpoint, if Level > 50' in said_of(fill), 'the condition')
    stands(editor, 'line 9 of Fill (instance ')
    until(lambda: re.search('value ([6-9][0-9]|5[1-9]|1[0-9][0-9])', said_of(fill)), 'the value')
    editor.shot('breakpoints-condition')
    editor.keys('shift+F8')
    until(lambda: not editor.all('Stands before line 9 of Fill', 'label'), 'the caller')
    editor.keys('F5')
    stands(editor, 'line 9 of Fill (instance ')


BODIES = '''RUNGBOARD 1

VAR
  Sum : INT;
END_VAR

FUNCTION Scaled : INT ST
VAR_INPUT
  X : INT;
END_VAR
VAR CONSTANT
  Most : INT := 5;
END_VAR
VAR
  i, t : INT;
END_VAR
  FOR i := 1 TO 3 DO
    t := t + X * i;
  END_FOR;
  Scaled := t;
END_FUNCTION

FUNCTION_BLOCK Grow ST
VAR_IN_OUT
  Total : INT;
END_VAR
VAR_TEMP
  Now : INT;
END_VAR
  Now := Total * 2;
  Total := Total + 1;
END_FUNCTION_BLOCK

PROGRAM Main ST
VAR
  A : Grow;
  n : INT;
END_VAR
  A(Total := n);
  Sum := Scaled(X := n);
  IF n > 200 THEN
    n := 0;
  END_IF;
END_PROGRAM
'''


def bodies(screen):
    """conditions read variables, constants and arrays of a function, VAR_TEMP and VAR_IN_OUT of a block; a call is refused"""
    editor, path, view = opened(screen, BODIES)
    for name, heading, line, condition, where in (
            ('Scaled, ST', 'FUNCTION Scaled', 13, 'i = 2 AND t > 30 AND X > Most', 'line 13 of Scaled, called from line 7 of Main'),
            ('Grow, ST', 'FUNCTION_BLOCK Grow', 9, 'Now > 100 AND Total < 190', 'line 9 of Grow (instance A), called from line 6 of Main')):
        editor.click(editor.find(name), count=2)
        body = text_of(editor, heading)
        to_line(editor, line)
        editor.keys('shift+F9')
        editor.focus_on('Condition of the breakpoint')
        if heading.endswith('Grow'):
            editor.type('Scaled(X := 3) > 1')
            editor.keys('Return')
            editor.find('While the program stands, a condition with a call cannot be computed', 'label')
            editor.keys('ctrl+a')
        editor.type(condition)
        editor.keys('Return')
        until(lambda: 'breakpoint, if ' + condition in said_of(body), 'the condition')
        stands(editor, where)
        editor.shot('breakpoints-body-' + heading.split()[-1])
        editor.keys('F9')
        until(lambda: 'breakpoint' not in said_of(body), 'no breakpoint')
        editor.keys('F5')
        goes_on(editor)


ACTIONS = '''RUNGBOARD 1

FUNCTION_BLOCK Fill ST
VAR_INPUT
  Step : INT;
END_VAR
VAR_OUTPUT
  Level : INT;
END_VAR
  Add();
ACTION Add:
  Level := Level + Step;
  Level := MIN(Level, 90);
END_ACTION
END_FUNCTION_BLOCK

PROGRAM Main ST
VAR
  A, B : Fill;
END_VAR
  A(Step := 1);
  B(Step := 30);
END_PROGRAM
'''


def actions(screen):
    """an action of a block has the names and values of its instance, in a condition, beside its lines and in the bar"""
    editor, path, view = opened(screen, ACTIONS)
    editor.click(editor.find('Fill.Add, ST'), count=2)
    action = until(lambda: next((n for n in editor.walk() if n.has(12) and n.text().lstrip().startswith('Level := Level')), None), 'the action')
    to_line(editor, 2)
    editor.keys('shift+F9')
    editor.focus_on('Condition of the breakpoint')
    editor.type('Step = 30 AND Level > 90')
    editor.keys('Return')
    stands(editor, 'line 2 of Fill.Add (instance B), called from line 8 of Fill (instance B)')
    until(lambda: 'value 120' in said_of(action), 'the value of B, not ' + said_of(action))
    editor.shot('breakpoints-action')
    editor.keys('F9')
    until(lambda: 'breakpoint' not in said_of(action), 'no breakpoint')
    editor.keys('F5')
    goes_on(editor)
    until(lambda: re.search('value [0-9]+', said_of(action)), 'the values of the first instance')


def edited(screen):
    """breakpoints stay with their lines while the text is edited; an edit ends the scan that stands, with the program before"""
    editor, path, view = opened(screen)
    to_line(editor, 8)
    editor.keys('F9')
    stands(editor, 'line 8 of Main')
    editor.keys('ctrl+Home', *['Down'] * 6, 'Home', 'Return', 'Up')
    editor.type('  Sum := 5;')
    goes_on(editor)
    until(lambda: 'Sum := 5;\n  Valve' in view.text(), 'the new line')
    editor.keys('ctrl+r')
    stands(editor, 'line 9 of Main')
    editor.keys('F9')
    until(lambda: 'breakpoint' not in said_of(view), 'no breakpoint')


def looks(screen):
    """in a dark small window, and in Chinese"""
    for kind, env in (Editor, {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}), (Chinese, {}):
        path = new_file(screen, PLANT)
        editor = kind(screen, path, **env)
        editor.click(editor.find('Main, ST'), count=2)
        text_of(editor, 'PROGRAM Main')
        editor.keys('ctrl+m', 'ctrl+Home', *['Down'] * 8, 'F9')
        until(lambda: editor.all(kind is Editor and 'Stands before line 9 of Main' or 'Main 第 9 行', 'label'), 'the bar')
        editor.keys('F7')
        until(lambda: editor.all(kind is Editor and 'Stands before line 8 of Fill' or 'Fill 第 8 行', 'label'), 'the bar')
        editor.shot('breakpoints-' + ('dark' if env else 'chinese'))
        editor.finish()


looks.size = '1024x600x24'
stepped.quick = 'editor-gtk/text'
main([stepped, by_pointer, conditional, bodies, actions, edited, looks])
