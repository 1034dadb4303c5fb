#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""execute - boxes of Structured Text in a ladder: typed, filled below the sheet, watched, copied, undone."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, Chinese, Editor, check, lines, main, new_file, until  # noqa: E402

EMPTY = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
  Level : INT;
  Sum   : INT;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | --- | COIL Lamp |
RUNG
  | [ Level > Sum ] | COIL %QX0.1 |
END_PROGRAM
'''
BOX = '''  | NO Start | EXECUTE Count | COIL Lamp |
  EXECUTE Count:
    Level := Level + 1;
    IF Level > 3 THEN
      Level := 0;
      Sum := Sum + 1;
    END_IF;
  END_EXECUTE
'''
COUNTED = EMPTY.replace('  | NO Start | --- | COIL Lamp |\n', BOX)


def text_of(editor):
    """The text, not its heading."""
    return until(lambda: [node for node in editor.all('Text of the program') if node.has(12)],
                 'the focus in the text')[0]


def described(view):
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def onto(editor, view, word):
    """The cursor in the first line with that text."""
    line = view.text()[:view.text().index(word)].count('\n')
    editor.keys('ctrl+Home', *['Down'] * line, 'End')


def good(editor):
    until(lambda: not [node for node in editor.all('error', 'label') if re.fullmatch('[0-9]+ errors?.*', node.name)],
          'no errors')


def written(screen):
    """a box is typed, Enter opens its statements, offers and mistakes are those of Structured Text, all is undone"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'Right')
    editor.entry('EXECUTE Count')
    box = editor.element('Rung 1', 'EXECUTE', 'Count')
    editor.click(box, count=2)
    view = text_of(editor)
    until(lambda: '  EXECUTE Count:\n    ;\n  END_EXECUTE\n' in view.text(), 'the new box')
    editor.keys('End', 'BackSpace')
    editor.type('Level = Level + 1;')
    editor.says('"Level =" compares and stores nothing')
    editor.shot('execute-wrong')
    onto(editor, view, 'Level = Level')
    editor.keys('shift+Home')
    editor.type('    Level := Level + 1;')
    until(lambda: 'Level := Level + 1;' in view.text(), 'the mended statement')
    editor.keys('End', 'Return')
    editor.type('IF')
    until(lambda: editor.all('whole statement', 'label') or editor.all('whole statement', 'list item'), 'the offer')
    editor.keys('Return')
    until(lambda: '    IF  THEN\n      \n    END_IF;' in view.text(), 'the whole statement')
    editor.type('Level > 3')
    editor.keys('Tab')
    editor.type('Level := 0;')
    editor.keys('Return')
    editor.type('Sum := Sum + 1;')
    until(lambda: 'Sum := Sum + 1;\n    END_IF;\n  END_EXECUTE' in view.text(), 'the last statement')
    good(editor)
    text = editor.save(path)
    assert BOX in text, text
    check(path)
    values = lines(path, '@print Level\nStart=1\n. x4\nStart=0\n')
    assert values == ['Level=%d' % level for level in (1, 2, 3, 0, 1, 1)], values
    editor.shot('execute-written')
    for _ in range(80):
        editor.keys('ctrl+z')
    until(lambda: 'EXECUTE' not in view.text(), 'the rung without the box')
    assert editor.save(path) == EMPTY


def watched(screen):
    """while simulating, power flows through the box and its lines have values; light, dark, and Chinese in a small window"""
    for make, env in (Editor, {}), (Editor, {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}), (Chinese, {}):
        editor = make(screen, new_file(screen, COUNTED), **env)
        editor.to_sheet()
        editor.keys('Home', 'Right', 'Return')
        view = text_of(editor)
        if make is Chinese:
            editor.shot('execute-chinese')
            editor.finish()
            continue
        editor.keys('ctrl+t')
        editor.says('scan 1')
        onto(editor, view, 'Level := Level + 1')
        until(lambda: 'result not run' in described(view), 'a line that did not run')
        editor.click(editor.find('Start, %IX0.0', 'check box'))
        editor.keys('ctrl+t', 'ctrl+t')
        editor.says('scan 3')
        editor.click(view)
        until(lambda: view.has(12), 'the focus in the text')
        onto(editor, view, 'Level := Level + 1')
        until(lambda: 'value 2' in described(view) and 'not run' not in described(view), 'a line that ran')
        editor.shot('execute-run' + ('-dark' if env else ''))
        editor.finish()


watched.size = '1024x600x24'


def copied(screen):
    """a rung is duplicated with its statements; the name of the box changes, its statements stay"""
    path = new_file(screen, COUNTED)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+d')
    editor.element('Rung 2', 'EXECUTE')
    text = editor.save(path)
    assert text.count(BOX) == 2, text
    editor.keys('ctrl+z')
    assert editor.save(path) == COUNTED
    editor.keys('Home', 'Right', 'shift+Return')
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('Add')
    text = editor.save(path)
    assert text == COUNTED.replace('EXECUTE Count', 'EXECUTE Add'), text
    check(path)
    editor.keys('Delete')
    text = editor.save(path)
    assert 'EXECUTE' not in text and 'Sum := Sum' not in text, text
    editor.keys('ctrl+z', 'ctrl+z')
    assert editor.save(path) == COUNTED


if __name__ == '__main__':
    main([written, watched, copied])
