#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chart_text - Structured Text in the actions of a chart, below its sheet."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from charts import asked, at, on_chart, shape, upon  # noqa: E402
from desk import A11Y, Editor, check, lines, main, new_file, until  # noqa: E402

MIXER = '''RUNGBOARD 1

PROGRAM Mixer SFC
  VAR
    Go    AT %IX0.0 : BOOL;
    Valve AT %QX0.0 : BOOL;
    Runs  : INT;
    Wait  : TON;
  END_VAR

  INITIAL_STEP Idle:
  END_STEP

  STEP Fill:
    Valve(N);
  END_STEP

  TRANSITION FROM Idle TO Fill := Go; END_TRANSITION

  TRANSITION FROM Fill TO Idle := Runs >= 3; END_TRANSITION
END_PROGRAM
'''
COUNTED = MIXER.replace('    Valve(N);\n', '    Valve(N);\n    Count(N);\n').replace('END_PROGRAM', '''
  ACTION Count:
    Runs := Runs + 1;
    IF NOT Fill.X THEN
      Runs := 0;
    END_IF;
    Wait(IN := Fill.X, PT := T#20ms);
  END_ACTION
END_PROGRAM''')


def text_of(editor):
    """The text, not its heading."""
    return until(lambda: [node for node in editor.all('Text of action Count', 'text') if node.has(12)],
                 'the focus in the text')[0]


def offered(editor, word):
    until(lambda: editor.all(word, 'label') or editor.all(word, 'list item'), 'the offer of ' + word)


def good(editor):
    until(lambda: not [node for node in editor.all('error', 'label') if re.fullmatch('[0-9]+ errors?.*', node.name)],
          'no errors')


def written(screen):
    """an action in Structured Text is made, written with offers and told mistakes, and undone, by keyboard"""
    path = new_file(screen, MIXER)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.keys('Home', 'Down', 'Down')
    at(editor, 'Step Fill')
    asked(editor, 'F9', 'ACTION Count ST')
    shape(editor, 'Fill does: N Count')
    editor.click(shape(editor, 'Fill does: N Count'), count=2)
    view = text_of(editor)
    until(lambda: view.text() == '    ;', 'the new action')
    editor.keys('End', 'BackSpace')
    editor.type('IF')
    offered(editor, 'whole statement')
    editor.shot('chart-text-offer')
    editor.keys('Return')
    until(lambda: '    IF  THEN\n      \n    END_IF;' in view.text(), 'the whole statement')
    editor.type('NOT Fill.X')
    editor.keys('Tab')
    editor.type('Runs = 0;')
    editor.says('"Runs =" compares and stores nothing')
    editor.shot('chart-text-wrong')
    editor.keys('ctrl+Left', 'ctrl+Left', 'ctrl+Left')
    editor.type(':')
    until(lambda: 'Runs := 0;' in view.text(), 'the mended statement')
    editor.keys('Down', 'End', 'Return')
    editor.type('Wait(')
    editor.find('Wait(IN : BOOL, PT : TIME, Q => BOOL, ET => TIME)', 'label')
    editor.type('IN := Fill.X, PT := T#20ms);')
    editor.keys('Return')
    editor.type('Runs := Runs + 1;')
    until(lambda: view.text().endswith('Runs := Runs + 1;'), 'the last statement')
    good(editor)
    text = editor.save(path)
    assert '''  ACTION Count:
    IF NOT Fill.X THEN
      Runs := 0;
    END_IF;
    Wait(IN := Fill.X, PT := T#20ms);
    Runs := Runs + 1;
  END_ACTION
''' in text, text
    check(path)
    assert lines(path, '@print Fill.X Runs\n.\nGo=1\nGo=0\n. x3\n')[-2:] == ['Runs=1', 'Runs=1']
    for _ in range(60):
        editor.keys('ctrl+z')
    until(lambda: not editor.all('Text of action Count'), 'the chart without the action')
    assert editor.save(path) == MIXER


def described(view):
    return str(view.editor.bus.call_blocking(view.editor.name, view.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def onto(editor, view, word):
    """The cursor in the first line with that text."""
    line = view.text()[:view.text().index(word)].count('\n')
    editor.keys('ctrl+Home', *['Down'] * line, 'End')


def watched(screen):
    """while simulating, lines of an action have values and say what ran; a condition says why; dark, too"""
    for env in {}, {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}:
        editor = Editor(screen, new_file(screen, COUNTED), **env)
        on_chart(editor)
        editor.click(shape(editor, 'Fill does: N Count'), count=2)
        view = text_of(editor)
        editor.keys('ctrl+t')
        editor.says('scan 1')
        onto(editor, view, 'Runs := Runs + 1')
        until(lambda: 'value 0, result not run' in described(view), 'a line that did not run')
        until(lambda: 'value 0, result not run' in described(view), 'a line that did not run')
        editor.click(editor.find('Go, %IX0.0', 'check box'))
        editor.keys('ctrl+t', 'ctrl+t')
        editor.says('scan 3')
        editor.click(view)
        until(lambda: view.has(12), 'the focus in the text')
        onto(editor, view, 'Runs := Runs + 1')
        until(lambda: 'value 2' in described(view) and 'not run' not in described(view), 'a line that ran')
        onto(editor, view, 'IF NOT Fill.X')
        until(lambda: 'value TRUE, result FALSE' in described(view), 'the condition')
        editor.shot('chart-text-run' + ('-dark' if env else ''))
        editor.keys('ctrl+F12')
        editor.says('FALSE: NOT Fill.X is not true')
        editor.click(max(editor.all('Close', 'push button'), key=lambda node: node.box()[1]))
        until(lambda: not editor.all('Text of action Count', 'text'), 'the text to be gone')
        on_chart(editor)
        editor.keys('Home')
        until(lambda: not editor.all('FALSE: NOT Fill.X is not true'), 'what was said of the text to be gone')
        editor.finish()


def stops(screen):
    """F9 in an action sets a breakpoint, also with a condition; where the scan stands, the text below the chart shows it, also after it was closed"""
    editor = Editor(screen, new_file(screen, COUNTED))
    on_chart(editor)
    editor.click(shape(editor, 'Fill does: N Count'), count=2)
    view = text_of(editor)
    onto(editor, view, 'Runs := Runs + 1')
    line = view.text()[:view.text().index('Runs := Runs + 1')].count('\n') + 1
    editor.keys('F9')
    until(lambda: 'breakpoint' in described(view), 'the breakpoint')
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    editor.click(editor.find('Go, %IX0.0', 'check box'))
    until(lambda: editor.all('Stands before line %d of Mixer.Count' % line, 'label'), 'the action')
    editor.shot('chart-text-stands')
    editor.keys('F8')
    until(lambda: editor.all('Stands before line %d of Mixer.Count' % (line + 1), 'label'), 'the next line')
    editor.click(max(editor.all('Close', 'push button'), key=lambda node: node.box()[1]))
    until(lambda: not editor.all('Text of action Count', 'text'), 'the text to be gone')
    editor.click(editor.find('Step over', 'push button'))
    until(lambda: not editor.all('Stands before line %d of Mixer.Count' % (line + 1), 'label'), 'another line')
    view = text_of(editor)
    onto(editor, view, 'Runs := Runs + 1')
    editor.keys('shift+F9')
    editor.focus_on('Condition of the breakpoint')
    editor.type('Runs = 2')
    editor.keys('Return')
    until(lambda: 'breakpoint, if Runs = 2' in described(view), 'the condition')


BOXED = MIXER.replace('    Valve(N);\n', '    Valve(N);\n    Count(N);\n').replace('END_PROGRAM', '''
  ACTION Count:
  RUNG
    | NO Fill.X | EXECUTE Add | COIL %QX0.1 |
    EXECUTE Add:
      Runs := Runs + 1;
    END_EXECUTE
  END_ACTION
END_PROGRAM''')


def on_box(editor, name, *keys):
    """The cursor of the rungs below the chart on the box of the first rung."""
    until(lambda: [node for node in editor.all('EXECUTE') if name in node.name], 'the box')
    editor.keys('Home', 'Right', *keys)


def boxed(screen):
    """Enter on a box in the rungs of an action shows its statements in their place; Close goes back; F2 renames the box; a breakpoint opens them"""
    path = new_file(screen, BOXED)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.click(shape(editor, 'Fill does: N Count'), count=2)
    on_box(editor, 'Add', 'Return')
    view = until(lambda: [node for node in editor.all('Statements of Add', 'text') if node.has(12)], 'the statements')[0]
    until(lambda: view.text().strip() == 'Runs := Runs + 1;', 'nothing but them')
    editor.keys('ctrl+Home', 'End', 'Return')
    editor.type('Valve := Runs > 2;')
    editor.keys('F9')
    until(lambda: 'breakpoint' in described(view), 'the breakpoint')
    editor.click(max(editor.all('Close', 'push button'), key=lambda node: node.box()[1]))
    on_box(editor, 'Add')
    until(lambda: [n for n in editor.all('Edit statements', 'label') if 'F2: Rename' in n.name], 'the keys of the box')
    editor.keys('F2')
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('Sum')
    on_box(editor, 'Sum')
    text = editor.save(path)
    assert 'EXECUTE Sum:\n        Runs := Runs + 1;\n        Valve := Runs > 2;\n' in text, text
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    editor.click(editor.find('Go, %IX0.0', 'check box'))
    until(lambda: editor.all('Stands before line 2 of Mixer.Sum', 'label') and editor.all('Statements of Sum', 'text'), 'the box')
    editor.shot('chart-text-boxed')


def rename(editor, text):
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    editor.keys('ctrl+a')
    editor.type(text)
    editor.keys('Return')
    until(lambda: not editor.all(role='dialog'), 'the dialog to be gone')


def renamed(screen):
    """a step that gets another name has it in the text, too; F2 in the text renames a variable everywhere"""
    path = new_file(screen, COUNTED)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.click(shape(editor, 'Fill does: N Count'), count=2)
    view = text_of(editor)
    editor.click(upon(editor, shape(editor, 'Step Fill')))
    at(editor, 'Step Fill')
    editor.keys('F2')
    rename(editor, 'Pour')
    until(lambda: 'IF NOT Pour.X THEN' in view.text() and 'IN := Pour.X' in view.text(), 'the new name')
    text = editor.save(path)
    assert 'STEP Pour:' in text and 'FROM Idle TO Pour' in text and 'Fill' not in text, text
    check(path)


if __name__ == '__main__':
    main([written, watched, stops, boxed, renamed])
