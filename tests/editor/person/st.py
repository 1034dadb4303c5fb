#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""st - programs in Structured Text, written and read in their sheet."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, Editor, check, lines, main, new_file, sh, until  # noqa: E402

TANK = '''RUNGBOARD 1

TYPE
  Phase  : (Idle, Filling := 3, Draining);
  Recipe : STRUCT
    Wanted : INT := 200;
    Time   : TIME;
  END_STRUCT;
END_TYPE

VAR
  Start AT %IX0.0 : BOOL;
  Level AT %IW2   : INT;
  Valve AT %QX0.0 : BOOL;
  Lamp  AT %QX0.1 : BOOL;
  Now   : Phase;
  Mix   : Recipe;
END_VAR

PROGRAM Main ST
VAR
  Wait : TON;
END_VAR
  (* fill (* up *) *)
  Valve := Start;
END_PROGRAM
'''


def in_the_text(screen, text=TANK, **env):
    """An editor with the keys in the text of that program, its path, and that text."""
    path = new_file(screen, text)
    editor = Editor(screen, path, **env)
    view = editor.find('Text of the program')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    return editor, path, view


def below(editor, view):
    """A new line below the last statement."""
    editor.keys('ctrl+Home', *['Down'] * 5, 'End', 'Return')
    until(lambda: 'Valve := Start;\n  \n' in view.text(), 'the new line')


def good(editor):
    until(lambda: any(re.fullmatch('[0-9]+ warnings?', node.name) for node in editor.all('warning', 'label')), 'no errors')


def offered(editor, word):
    until(lambda: editor.all(word, 'label') or editor.all(word, 'list item'), 'the offer of ' + word)


def completed(screen):
    """a whole statement appears, Tab goes through it; members, pins, values and what a call takes are told; lines indent themselves"""
    editor, path, view = in_the_text(screen)
    below(editor, view)
    editor.type('IF')
    offered(editor, 'whole statement')
    editor.shot('st-whole')
    editor.keys('Return')
    until(lambda: 'IF  THEN\n    \n  END_IF;' in view.text(), 'the whole statement')
    editor.type('Level < Mix.')
    offered(editor, 'Wanted')
    editor.shot('st-members')
    editor.type('W')
    editor.keys('Return')
    until(lambda: 'Mix.Wanted THEN' in view.text(), 'the member')
    editor.keys('Tab')
    editor.type('Wait(')
    editor.find('Wait(IN : BOOL, PT : TIME, Q => BOOL, ET => TIME)', 'label')
    editor.shot('st-call')
    editor.type('P')
    offered(editor, 'PT :=')
    editor.keys('Return')
    editor.type('T#1s, IN := TRUE);')
    until(lambda: 'Wait(PT := T#1s, IN := TRUE);' in view.text(), 'the call')
    until(lambda: not editor.all('Wait(IN :', 'label'), 'no call at the cursor')
    editor.keys('Return')
    editor.type('Now := ')
    editor.keys('ctrl+space')
    offered(editor, 'Draining')
    editor.shot('st-values')
    editor.type('Fil')
    editor.keys('Return')
    editor.type(';')
    editor.keys('Return')
    editor.type('Now := Phase#')  # the sign alone opens the list
    offered(editor, 'Draining')
    editor.type('Fil')
    editor.keys('Return')
    until(lambda: 'Now := Phase#Filling' in view.text(), 'the value of the type')
    editor.type(';')
    editor.keys('Return')
    editor.type('WHILE FALSE DO')
    editor.keys('Return')
    editor.type(';')
    editor.keys('Return')
    editor.type('END_WHILE;')
    until(lambda: '    Now := Filling;\n    Now := Phase#Filling;\n    WHILE FALSE DO\n      ;\n    END_WHILE;\n  END_IF;' in view.text(), 'the lines')
    good(editor)
    editor.save(path)
    check(path)
    assert lines(path, '@print Now\n.\n') == ['Now=Filling']


def wrong(screen):
    """a mistake is underlined and told at its line while typing"""
    editor, path, view = in_the_text(screen)
    below(editor, view)
    editor.type('Lamp = Start;')
    editor.says('"Lamp =" compares and stores nothing')
    editor.shot('st-wrong')
    editor.keys('ctrl+Left', 'ctrl+Left', 'ctrl+Left')
    editor.type(':')
    good(editor)
    editor.save(path)
    check(path)


NAMED = TANK.replace('  Valve := Start;', """  IF Limited(X := Level) > Mix.Wanted THEN
    Valve := Start;
  END_IF;
  Wait(IN := Valve, PT := Mix.Time, Q => Lamp);
  IF Lamp THEN
    Now := Filling;
  END_IF;""").replace('PROGRAM Main ST', """FUNCTION Limited : INT ST
VAR_INPUT
  X : INT;
END_VAR
  Limited := MIN(X, 1000);
END_FUNCTION

PROGRAM Main ST""")


def to_program(editor, name='PROGRAM Main'):
    """Brings the text of that program to the front, with the keys in it."""
    editor.click(editor.find(name.split()[-1] + ', ST'), count=2)
    view = editor.focus_on('Text of the program', 'text')
    assert name in view.text(), view.text()
    return view


def go(editor, view, before, word):
    """Moves the cursor into a word of the text."""
    text = view.text()
    at = text.index(before) + before.index(word) + 1
    line = text[:at].count('\n')
    column = at - text.rfind('\n', 0, at) - 1
    editor.keys('ctrl+Home', *['Down'] * line, *['Right'] * column)
    editor.says('Line %d \u00b7 column %d' % (line + 1, column + 1))


def names(screen):
    """F12 goes to the definition of a name, Shift+F12 lists its uses, F2 renames it, in the texts and elsewhere; find and replace"""
    path = new_file(screen, NAMED)
    editor = Editor(screen, path)
    view = to_program(editor)
    go(editor, view, 'Wait(', 'Wait')
    editor.says('F12: Go to definition')
    editor.keys('F12')
    editor.says('Line 3 \u00b7 column 3')
    editor.keys('F12')  # from the definition to what drives it
    editor.says('Line 9 \u00b7 column 3')
    go(editor, view, 'Limited(', 'Limited')
    editor.keys('F12')
    until(lambda: [n for n in editor.all('Text of the program') if 'FUNCTION Limited' in n.text() and n.has(12)], 'the function')
    view = to_program(editor)
    go(editor, view, 'Mix.Wanted', 'Wanted')
    editor.keys('F12')
    until(lambda: [n for n in editor.walk() if n.has(12) and n.text() == 'Wanted'] or editor.all('STRUCT'), 'the structure')
    editor.shot('st-definition')
    view = to_program(editor)
    go(editor, view, 'Level)', 'Level')
    editor.keys('shift+F12')
    editor.find('Main, line 6', 'label')
    editor.shot('st-uses')
    editor.click(view)
    go(editor, view, 'Level)', 'Level')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Height')
    editor.keys('Return')
    until(lambda: 'X := Height' in view.text(), 'the new name')
    go(editor, view, 'Mix.Wanted', 'Wanted')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Goal')
    editor.keys('Return')
    until(lambda: '> Mix.Goal' in view.text(), 'the new name of the member')
    editor.keys('ctrl+h')
    editor.type('1000')
    editor.find('1 hit')
    editor.keys('Tab')
    editor.into('Replace with')
    editor.type('900')
    editor.find('Replace all', 'push button').press()
    until(lambda: [n for n in editor.all('Text of the program') if 'MIN(X, 900)' in n.text()], 'what was replaced')
    text = editor.save(path)
    wanted = NAMED.replace('Level', 'Height').replace('Wanted', 'Goal').replace('1000', '900')
    assert text.split() == wanted.split(), text
    check(path)


SHARED = '''RUNGBOARD 1

TYPE
  Phase : (Idle, Run);
  Mode  : (Idle, Auto);
  Axis  : STRUCT
    Pos  : INT;
    Goal : INT;
  END_STRUCT;
END_TYPE

VAR
  Now   : Phase;
  How   : Mode;
  Table : ARRAY[1..3] OF Axis;
  Sum   : INT;
END_VAR

FUNCTION Limited : INT ST
VAR_INPUT
  X, Top : INT;
END_VAR
  Limited := MIN(X, Top);
END_FUNCTION

PROGRAM Main ST
VAR
  i, k : INT;
END_VAR
  Now := Idle; How := Idle;
  IF Now = Idle AND Idle = How THEN
    Table[i].Pos := Limited(X := Table[k].Goal, Top := 100);
  END_IF;
END_PROGRAM
'''


def shared(screen):
    """a value that two enumerations have, a member in an array, an input in a call: uses, definition and new name are those of the one that is meant; lines are those of the sheet, though the file has others"""
    path = new_file(screen, SHARED)
    editor = Editor(screen, path)
    for before, word, place, target, new in (
            ('How := Idle', 'Idle', 'Main, line 7', 'Mode#Idle', 'Still'),
            ('Now := Idle', 'Idle', 'Main, line 6', 'Phase#Idle', 'Rest'),
            ('.Pos :=', 'Pos', 'Main, line 9', 'Axis.Pos', 'Place'),
            ('Top := 100', 'Top', 'Main, line 9', 'Limited.Top', 'Most')):
        view = to_program(editor)
        go(editor, view, before, word)
        editor.keys('shift+F12')
        editor.find(target, 'label')
        editor.find(place, 'label')
        editor.shot('st-shared-' + new)
        view = to_program(editor)
        go(editor, view, before, word)
        editor.keys('F12')
        until(lambda: [n for n in editor.walk() if n.has(12) and n.text() == word] or
              [n for n in editor.all('Text of the program') if n.has(12) and 'FUNCTION Limited' in n.text()],
              'the definition of ' + target)
        view = to_program(editor)
        go(editor, view, before, word)
        editor.brought('F2')
        editor.keys('ctrl+a')
        editor.type(new)
        editor.keys('Return')
        until(lambda: before.replace(word, new) in view.text(), 'the new name of ' + target)
    text = editor.save(path)
    for line in ('Phase : (Rest, Run)', 'Mode  : (Still, Auto)', 'Now := Rest;', 'How := Still;', 'IF Now = Rest AND Still = How THEN',
                 'Table[i].Place := Limited(X := Table[k].Goal, Most := 100);', 'Limited := MIN(X, Most);', 'Place : INT;'):
        assert line in text, line + ' is not in\n' + text
    check(path)


def formatted(screen):
    """Ctrl+Alt+F formats the text, Ctrl+Alt+M mends a line; both say what hinders them; undo brings the text back"""
    editor, path, view = in_the_text(screen)
    below(editor, view)
    editor.type('if Start then Lamp:=TRUE')
    editor.keys('ctrl+alt+f')
    editor.says('The text cannot be read yet')
    editor.type('; end_if')
    good(editor)
    editor.keys('ctrl+alt+f')
    until(lambda: '  IF Start THEN\n    Lamp := TRUE;\n  END_IF;\n' in view.text(), 'the formatted text')
    editor.shot('st-formatted')
    editor.keys('ctrl+alt+m')
    editor.says('No error in this line can be mended')
    editor.keys('ctrl+End', 'Up', 'Up', 'End', 'Return')
    editor.type('Lamp = Start;')
    editor.says('Ctrl+Alt+M: Mend the line')
    editor.shot('st-mend')
    editor.keys('ctrl+alt+m')
    until(lambda: 'Lamp := Start;' in view.text(), 'the mended line')
    good(editor)
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z', 'ctrl+z')
    until(lambda: 'Lamp' not in view.text(), 'what was before')


def described(view):
    """What a screen reader adds to the name of the text: the values of the line of the cursor."""
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def simulated(screen):
    """while simulating, each line shows its values, conditions what they were, and lines that did not run say so; so in a dark, small window; a screen reader hears it"""
    for env in {}, {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}:
        editor, _, view = in_the_text(screen, NAMED[:NAMED.index('FUNCTION')] + NAMED[NAMED.index('PROGRAM Main'):].replace('Limited(X := Level)', 'Level'), **env)
        if env:
            sh('xdotool', 'windowsize', '--sync', editor.window, '1024', '600')
        editor.keys('ctrl+m')
        editor.says('SIMULATION')
        go(editor, view, 'Valve := Start', 'Valve')
        until(lambda: 'result not run' in described(view), 'a line that did not run')
        go(editor, view, 'Now := Filling', 'Now')
        until(lambda: 'value Idle' in described(view), 'the name of the value')
        go(editor, view, 'IF Level', 'Level')
        until(lambda: 'value 0 \u00b7 200, result FALSE' in described(view), 'the condition')
        editor.keys('ctrl+F12')
        editor.says('FALSE: Level > Mix.Wanted is not true (Level = 0, Mix.Wanted = 200)')
        editor.shot('st-simulated' + ('-dark' if env else ''))
        editor.finish()


PLAIN = '''TYPE
  Phase : (Idle, Filling := 3, Draining);
END_TYPE

PROGRAM Main
VAR
  Wait : TON;
  Now  : Phase;
END_VAR
  Wait(IN := TRUE, PT := T#1s);
END_PROGRAM
'''


def plain(screen):
    """a file of plain IEC text has the same sheet, and stays such a file"""
    path = new_file(screen, PLAIN, 'plant.st')
    editor = Editor(screen, path)
    view = editor.find('Text of the program')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    editor.keys('ctrl+Home', *['Down'] * 5, 'End', 'Return')
    editor.type('Now := Dr')
    offered(editor, 'Draining')
    editor.keys('Return')
    editor.type(';')
    good(editor)
    editor.shot('st-plain')
    assert editor.save(path) == PLAIN.replace('T#1s);', 'T#1s);\n  Now := Draining;')
    check(path)


completed.quick = 'editor-gtk/text'
main([completed, wrong, names, shared, formatted, simulated, plain])
