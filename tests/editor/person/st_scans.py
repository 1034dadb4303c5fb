#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""st_scans - Structured Text that runs, scan by scan, by keyboard alone and in each language: values, lines that
did not run, why a condition is so, and the scans before."""
import gettext
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, BUILD, Editor, main, new_file, sh, until  # noqa: E402

COUNT = '''RUNGBOARD 1

VAR
  Valve AT %QX0.0 : BOOL;
  Sum   : INT;
END_VAR

PROGRAM Main ST
VAR
  n : INT;
END_VAR
  n := n + 1;
  IF n MOD 3 = 0 AND n < 100 THEN
    Sum := Twice(X := n);
  ELSE
    Valve := n > 1;
  END_IF;
END_PROGRAM

FUNCTION Twice : INT ST
VAR_INPUT
  X : INT;
END_VAR
  Twice := X + X;
END_FUNCTION
'''


class Foreign(Editor):
    """The same, with the texts to look for in the language of the editor."""

    def __init__(self, screen, language, *files, **env):
        self.said = gettext.translation('rungboard', os.path.join(BUILD, 'locale'), [language]) if language else \
            gettext.NullTranslations()
        super().__init__(screen, *files, LANGUAGE=language, **env)

    def shown_as(self, text):
        return self.said.gettext(text)


def described(view):
    """What a screen reader adds to the name of the text: values and marks of the line of the cursor."""
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def at_line(editor, view, line, *wanted):
    """Moves the cursor to line @line, from 1, and waits until the reader is told all of these."""
    editor.keys('ctrl+Home', *['Down'] * (line - 1))
    until(lambda: all(word in described(view) for word in wanted), 'line %d: %s, not %s' % (line, wanted, described(view)))


def stepped_to(screen, language='', **env):
    """An editor whose simulation has done six scans, one by one, and the text that has the keys. No pointer is used."""
    editor = Foreign(screen, language, new_file(screen, COUNT), **env)
    view = until(lambda: next((n for n in editor.all('Text of the program') if n.has(12)), None), 'the keys in the text')
    if env:
        sh('xdotool', 'windowsize', '--sync', editor.window, '1024', '600')
    editor.keys('ctrl+m')
    editor.find('Stop with safe outputs', 'push button')
    editor.keys('ctrl+shift+r')  # STOP: the next scan is the first one again
    editor.find('SIMULATION \u00b7 STOP', 'label')
    return editor, view


def scrubbed(screen):
    """six scans one by one: the lines have the values of each, also of a function, say which did not run and why; Alt+Left shows the scans before, Alt+End the newest"""
    editor, view = stepped_to(screen)
    for _ in range(6):
        editor.keys('ctrl+t')
    at_line(editor, view, 5, 'value 6')
    at_line(editor, view, 6, 'value 6', 'result TRUE')
    editor.keys('ctrl+F12')
    editor.says('TRUE: n MOD 3 = 0 is true (n = 6); and n < 100 is true (n = 6)')
    at_line(editor, view, 7, 'value 12 \u00b7 6')
    at_line(editor, view, 9, 'not run')
    editor.shot('st-scans-newest')
    editor.keys('alt+Left')
    until(lambda: 'not run' not in described(view), 'the line ran in the scan before')
    at_line(editor, view, 5, 'value 5')
    at_line(editor, view, 6, 'value 5', 'result FALSE')
    editor.keys('ctrl+F12')
    editor.says('FALSE: n MOD 3 = 0 is not true (n = 5)')
    at_line(editor, view, 7, 'value 6', 'not run')
    editor.shot('st-scans-before')
    editor.keys('alt+Left', 'alt+Left')
    at_line(editor, view, 7, 'value 6 \u00b7 3')
    assert 'not run' not in described(view), described(view)
    editor.keys('alt+Right')
    at_line(editor, view, 7, 'not run')
    editor.keys('alt+End')
    at_line(editor, view, 5, 'value 6')
    assert 'n := n + 1;' in view.text()


def languages(screen):
    """the marks in German, French and Chinese, in a dark, small window, for the eye and for a screen reader"""
    for language in 'de', 'fr', 'zh_CN':
        editor, view = stepped_to(screen, language, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
        for _ in range(2):
            editor.keys('ctrl+t')
        at_line(editor, view, 7, editor.shown_as('not run'))
        at_line(editor, view, 6, 'FALSE')
        editor.keys('ctrl+F12')
        until(lambda: [n for n in editor.walk() if n.name.startswith(editor.shown_as('FALSE: ').strip()) and 'n = 2' in n.name],
              'why in ' + language)
        editor.shot('st-scans-' + language)
        editor.keys('F9')
        until(lambda: re.search(re.escape(editor.shown_as('breakpoint')), described(view)), 'the breakpoint in ' + language)
        editor.keys('ctrl+r')
        editor.find('Step over', 'push button')
        editor.shot('st-scans-stands-' + language)
        editor.finish()


main([scrubbed, languages])
