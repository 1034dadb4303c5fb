#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""st - programs in Structured Text, written and read in their sheet."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

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
    until(lambda: editor.all('warning', 'label') and not editor.all(' error', 'label'), 'no errors')


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
    editor.type('WHILE FALSE DO')
    editor.keys('Return')
    editor.type(';')
    editor.keys('Return')
    editor.type('END_WHILE;')
    until(lambda: '    Now := Filling;\n    WHILE FALSE DO\n      ;\n    END_WHILE;\n  END_IF;' in view.text(), 'the lines')
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


completed.quick = 'editor-gtk/text'
main([completed, wrong])
