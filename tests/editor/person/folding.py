#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""folding - blocks of a text are folded to their first line and unfolded by what needs to show them."""
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

PROGRAM Main ST
VAR
  i : INT;
  n : INT;
END_VAR
  n := n + 1;
  (* The sum of
     what is even. *)
  FOR i := 1 TO 10 DO
    IF i MOD 2 = 0 THEN
      Sum := Sum + i;
    END_IF;
  END_FOR;
  CASE n OF
    1:
      Valve := Start;
  ELSE
      Valve := NOT Valve;
  END_CASE;
  n := n * 2 MOD 7;
END_PROGRAM
'''


LINE = 16  # height in px


def said_of(view):
    """What a screen reader adds to the name of the text."""
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def opened(screen, text=PLANT, kind=Editor, **env):
    """An editor, and the text of Main, which has the keys."""
    path = new_file(screen, text)
    editor = kind(screen, path, **env)
    editor.click(editor.find('Main, ST'), count=2)

    def look():
        found = [n for n in editor.all('Text of the program') if n.has(12) and n.text().startswith('PROGRAM Main')]
        return found[0] if found else None
    return editor, path, until(look, 'the text of Main')


def to_line(editor, line):
    """Moves the cursor to the begin of line @line, from 1; no line before it is folded."""
    editor.keys('ctrl+Home', *['Down'] * (line - 1))
    editor.says('Line %d · column 1' % line)


def says_folded(view, lines):
    until(lambda: 'folded, %d line' % lines in said_of(view), '%d hidden lines' % lines)


def place_of_triangle(editor, view, line):
    """The place beside line @line, from 1, of a text that is not scrolled."""
    (left, _, width, _), (_, top, _, _) = editor.find('Blocks to fold').box(), view.box()
    return left + width // 2, top + LINE * (line - 1) + LINE // 2


def shown(view, hidden):
    """Waits until the screen reader is told nothing about folds in the line of the cursor, or so many hidden lines."""
    until(lambda: (('folded, %d line' % hidden) in said_of(view)) if hidden else 'folded' not in said_of(view), '%d hidden lines' % hidden)


def by_keys(screen):
    """Ctrl+Shift+[ folds a block and the one around it, the cursor goes past what is hidden, Ctrl+Shift+] unfolds; the file keeps its text; the list of commands folds all"""
    editor, path, view = opened(screen)
    before = view.text()
    to_line(editor, 11)
    editor.keys('ctrl+shift+bracketleft')
    editor.says('Line 10 · column 5')
    shown(view, 2)
    editor.keys('Down')
    editor.says('Line 13 ·')
    editor.keys('Up')
    editor.says('Line 10 ·')
    editor.keys('ctrl+shift+bracketleft')
    editor.says('Line 9 ·')
    shown(view, 4)
    editor.keys('Down')
    editor.says('Line 14 ·')
    editor.keys('ctrl+shift+bracketleft')
    shown(view, 5)
    editor.shot('folding-keys')
    editor.keys('Up', 'ctrl+shift+bracketright')
    shown(view, 0)
    editor.keys('ctrl+shift+bracketright')
    editor.says('No folded block begins in this line.')
    editor.command('Fold all blocks')
    editor.says('Line 9 ·')
    shown(view, 4)
    editor.keys('Up')
    editor.says('Line 7 ·')
    shown(view, 1)
    editor.shot('folding-all')
    editor.keys('End')
    editor.type('!')
    until(lambda: 'The sum of!' in view.text(), 'the letter')
    shown(view, 1)
    editor.keys('ctrl+s')
    until(lambda: open(path).read() == PLANT.replace('sum of', 'sum of!'), 'the whole text in the file')
    assert 'END_VAR' not in view.text() and 'Sum' not in view.text(), view.text()  # a screen reader reads what is shown
    editor.command('Unfold all blocks')
    until(lambda: view.text() == before.replace('sum of', 'sum of!'), 'all lines')
    shown(view, 0)


def by_pointer(screen):
    """a press on a triangle folds and unfolds its block; marks, values and numbers beside the other lines stay right while it is simulated"""
    editor, path, view = opened(screen)
    to_line(editor, 9)
    editor.keys('F9')
    until(lambda: 'breakpoint' in said_of(view), 'the breakpoint')
    editor.keys('ctrl+shift+bracketleft')
    shown(view, 4)
    editor.keys('ctrl+shift+bracketright')
    shown(view, 0)
    editor.keys('F9')
    until(lambda: 'breakpoint' not in said_of(view), 'no breakpoint')
    editor.keys('ctrl+Home')
    triangle = place_of_triangle(editor, view, 9)
    editor.click(triangle)
    to_line(editor, 9)
    shown(view, 4)
    editor.click(triangle)
    shown(view, 0)
    editor.click(triangle)
    shown(view, 4)
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    editor.keys('Up', 'Up', 'Up')
    until(lambda: re.search('value [0-9]', said_of(view)), 'a value')
    editor.shot('folding-values')


def shows(screen):
    """what needs hidden lines unfolds them: a search, an error, the line before which the program stands"""
    editor, path, view = opened(screen)
    editor.command('Fold all blocks')
    editor.keys('ctrl+Home', 'Down', 'Down')
    editor.says('Line 6 ·')
    editor.keys('ctrl+f')
    editor.focus_on(role='text')
    editor.type('Sum + i')
    editor.keys('Return', 'Escape')
    editor.says('Line 11 ·')
    editor.keys('Up', 'ctrl+shift+bracketleft', 'ctrl+shift+bracketleft')
    editor.says('Line 9 ·')
    shown(view, 4)
    editor.keys('ctrl+Home', 'ctrl+m')
    editor.says('SIMULATION')
    editor.keys('F9')
    until(lambda: editor.all('Stands before line 6 of Main', 'label'), 'the first statement')
    editor.keys('F8')
    until(lambda: editor.all('Stands before line 9 of Main', 'label'), 'the loop')
    shown(view, 4)
    editor.keys('F8')
    until(lambda: editor.all('Stands before line 10 of Main', 'label'), 'the line in the loop')
    editor.says('Line 10 ·')
    shown(view, 2)  # what is in it
    editor.shot('folding-stands')


def looks(screen):
    """in a dark small window, and in Chinese"""
    for kind, env, unit in (Editor, {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}, 'folded, 4 lines'), (Chinese, {}, '已折叠,隐藏 4 行'):
        editor, path, view = opened(screen, kind=kind, **env)
        editor.keys('ctrl+Home', *['Down'] * 8)
        editor.keys('ctrl+shift+bracketleft')
        until(lambda: unit in said_of(view), 'the fold')
        editor.keys('ctrl+m')
        editor.find('Valve', 'label')
        editor.shot('folding-' + ('dark' if env else 'chinese'))
        editor.finish()


looks.size = '1024x600x24'
by_keys.quick = 'editor-gtk/text'
main([by_keys, by_pointer, shows, looks])
