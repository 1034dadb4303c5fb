#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""execute - boxes of Structured Text in a ladder, and actions of a program: typed, filled below the sheet, watched, copied, undone."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from chart_text import described, onto  # noqa: E402
from desk import Chinese, Editor, check, lines, main, new_file, until  # noqa: E402

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
ACTED = '''PROGRAM Main
VAR
  Scans : INT;
  Lamp  AT %QX0.0 : BOOL;
END_VAR
  Count();
END_PROGRAM

ACTION Count:
  Scans := Scans + 1;
END_ACTION
'''
COUNTED = EMPTY.replace('  | NO Start | --- | COIL Lamp |\n', BOX)


def text_of(editor):
    """The text, not its heading."""
    name = 'Count 的语句' if isinstance(editor, Chinese) else 'Statements of Count'
    return until(lambda: [node for node in editor.all(name) if node.has(12)], 'the focus in the text')[0]


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
    until(lambda: view.text() == '    ;', 'the new box')
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
    until(lambda: view.text().endswith('Sum := Sum + 1;\n    END_IF;'), 'the last statement')
    good(editor)
    text = editor.save(path)
    assert BOX in text, text
    check(path)
    values = lines(path, '@print Level\nStart=1\n. x4\nStart=0\n')
    assert values == ['Level=%d' % level for level in (1, 2, 3, 0, 1, 1)], values
    editor.shot('execute-written')
    for _ in range(80):
        editor.keys('ctrl+z')
    until(lambda: not editor.all('Statements of Count'), 'the rung without the box')
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


def stops(screen):
    """F9 sets a breakpoint in a box; the scan stands before its line, steps, and goes on; it moves with its line"""
    path = new_file(screen, COUNTED)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'Right', 'Return')
    view = text_of(editor)
    onto(editor, view, 'Level := 0')
    editor.keys('F9')
    until(lambda: 'breakpoint' in described(view), 'the breakpoint')
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    editor.click(editor.find('Start, %IX0.0', 'check box'))
    until(lambda: editor.all('Stands before line 3 of Main.Count', 'label'), 'the line')
    editor.shot('execute-stands')
    editor.keys('F8')
    until(lambda: editor.all('Stands before line 4 of Main.Count', 'label'), 'the next line')
    editor.click(max(editor.all('Close', 'push button'), key=lambda node: node.box()[1]))
    until(lambda: not editor.all('Statements of Count'), 'the statements to be gone')
    editor.click(editor.find('Continue', 'push button'))
    until(lambda: editor.all('Stands before line 3 of Main.Count', 'label') and editor.all('Statements of Count'), 'four scans later')
    view = text_of(editor)
    onto(editor, view, 'Level := 0')
    editor.keys('F9')
    until(lambda: 'breakpoint' not in described(view), 'no breakpoint')
    onto(editor, view, 'Level := Level + 1')
    editor.keys('shift+F9')
    editor.focus_on('Condition of the breakpoint')
    editor.type('Sum = 3')
    editor.keys('Return')
    until(lambda: 'breakpoint, if Sum = 3' in described(view), 'the condition')
    editor.click(editor.find('Continue', 'push button'))
    until(lambda: editor.all('Stands before line 1 of Main.Count', 'label'), 'the condition to hold')
    editor.click(max(editor.all('Close', 'push button'), key=lambda node: node.box()[1]))
    editor.to_sheet()
    editor.keys('Home', 'ctrl+d')  # another rung with such a box above; the breakpoint stays with its own
    editor.element('Rung 2', 'EXECUTE')
    editor.keys('ctrl+z')
    editor.keys('Right', 'Return')
    view = text_of(editor)
    editor.keys('ctrl+Home')
    until(lambda: 'breakpoint, if Sum = 3' in described(view), 'the breakpoint at its line')


def action(screen):
    """an action of a program has a sheet of its statements alone: edited, a mistake told, a breakpoint, undone"""
    path = new_file(screen, ACTED).replace('.rung', '.st')
    os.rename(path.replace('.st', '.rung'), path)
    editor = Editor(screen, path)
    editor.click(editor.find('Main.Count, ST'), count=2)
    view = until(lambda: [node for node in editor.all('Text of action Count', 'text') if node.has(12)], 'the focus in the text')[0]
    until(lambda: view.text() == '  Scans := Scans + 1;', 'its statements')
    editor.keys('ctrl+End', 'Return')
    editor.type('Lamp = Scans > 3;')
    editor.says('"Lamp =" compares and stores nothing')
    until(lambda: editor.all('Main.Count, line 2', 'label'), 'the place of the mistake')
    editor.keys('ctrl+alt+m')
    until(lambda: 'Lamp := Scans > 3;' in view.text(), 'the mended line')
    editor.keys('F9', 'ctrl+m')
    until(lambda: editor.all('Stands before line 2 of Main.Count, called from line 6 of Main', 'label'), 'the action')
    editor.shot('action-stands')
    editor.keys('F9', 'F5')
    until(lambda: 'value TRUE' in described(view) or 'result TRUE' in described(view), 'the lamp')
    assert editor.save(path) == ACTED.replace('Scans + 1;', 'Scans + 1;\n  Lamp := Scans > 3;')
    for _ in range(25):
        editor.keys('ctrl+z')
    until(lambda: view.text() == '  Scans := Scans + 1;', 'what was before')


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
    editor.keys('Home', 'Right', 'F2')
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
    main([written, watched, stops, action, copied])
