#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Names, comments, priorities and macro-steps on the sheet of a chart, by keys and by pointer."""
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

TANK = '''RUNGBOARD 1

PROGRAM Main SFC
  VAR
    Start AT %IX0.0 : BOOL;
    Full  AT %IX0.1 : BOOL;
    Hot   AT %IX0.2 : BOOL;
    Valve AT %QX0.0 : BOOL;
    Count : INT;
  END_VAR

  INITIAL_STEP Idle:
  END_STEP

  TRANSITION FROM Idle TO Fill := Start; END_TRANSITION

  STEP Fill:
    Valve(N);
    Counting(P1);
  END_STEP

  TRANSITION FROM Fill TO Heat := Full; END_TRANSITION

  TRANSITION FROM Fill TO Idle := NOT Start; END_TRANSITION

  STEP Heat:
  END_STEP

  TRANSITION FROM Heat TO Idle := Hot AND Fill.T > T#1s; END_TRANSITION

  ACTION Counting:
    RUNG
      | NO Valve | ADD IN1:=Count IN2:=1 OUT=>Count | COIL %MX1.0 |
  END_ACTION
END_PROGRAM
'''


def on_chart(editor):
    until(lambda: editor.find('Chart').has(12), 'the focus on the chart')


def shape(editor, *parts):
    def look():
        found = [node for node in editor.all(role='table cell') if all(part in node.name for part in parts)]
        return found[0] if found else None
    return until(look, 'what is called %s' % ', '.join(parts))


def at(editor, text):
    """Waits until the cursor is on the shape whose name has this text."""
    until(lambda: shape(editor, text).has(23), 'the cursor at ' + text)


def go(editor, text):
    """Goes to a step by the key for that."""
    on_chart(editor)
    editor.keys('ctrl+g')
    editor.opened()
    editor.entry(text)
    on_chart(editor)
    at(editor, 'Step ' + text)


def asked(editor, key, text):
    on_chart(editor)
    editor.keys(key)
    editor.opened()
    if text:
        editor.entry(text)
    else:
        editor.keys('ctrl+a', 'BackSpace', 'Return')
        editor.gone()
    on_chart(editor)


def rename(editor, text):
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    editor.keys('ctrl+a')
    editor.type(text)
    editor.keys('Return')
    until(lambda: not editor.all(role='dialog'), 'the dialog to be gone')
    on_chart(editor)


def opened(screen):
    path = new_file(screen, TANK)
    editor = Editor(screen, path)
    on_chart(editor)
    shape(editor, 'Step Idle, initial')
    return path, editor


def upon(editor, node):
    x, y, _, height = editor.place(node)
    return x + 11, y + height // 2


def menu(editor, node, verb):
    editor.click(upon(editor, node), button=3)
    item = until(lambda: editor.all(verb, 'menu item'), 'the menu')[0]
    item.press()


def renamed(screen):
    """F2 renames steps, actions, variables and names in conditions; F12 and Shift+F12 work on them"""
    path, editor = opened(screen)
    go(editor, 'Fill')
    editor.keys('F2')
    rename(editor, 'Filling')
    shape(editor, 'Step Filling')
    text = editor.save(path)
    assert 'Fill ' not in text and 'Filling.T > T#1s' in text and 'FROM Filling TO Heat' in text, text
    check(path)
    # The variable of a step's line, by the context menu.
    menu(editor, shape(editor, 'Filling does: N Valve'), 'Rename everywhere')
    rename(editor, 'Inlet')
    text = editor.save(path)
    assert 'Valve' not in text and '    Inlet(N);' in text and '| NO Inlet |' in text, text
    # The action that the other line calls.
    editor.click(shape(editor, 'Filling does: P1 Counting'))
    at(editor, 'does: P1 Counting')
    editor.keys('F2')
    rename(editor, 'Tally')
    shape(editor, 'does: P1 Tally')
    # A name in a condition.
    editor.click(upon(editor, shape(editor, 'from Filling to Heat')))
    at(editor, 'from Filling to Heat')
    editor.keys('F2')
    rename(editor, 'Level')
    shape(editor, 'from Filling to Heat, condition Level')
    text = editor.save(path)
    assert 'ACTION Tally:' in text and '    Level AT %IX0.1 : BOOL;' in text, text
    check(path)
    # All uses of the step; activating a row returns to the chart.
    go(editor, 'Filling')
    editor.keys('shift+F12')
    until(lambda: editor.all('Main.Filling', 'label'), 'the uses')
    editor.says('entered')
    editor.shot('chart-uses')
    # "Where it is driven" of a step: the transition that enters it.
    go(editor, 'Filling')
    editor.keys('F12')
    at(editor, 'from Idle to Filling')
    for _ in range(4):
        editor.keys('ctrl+z')
    until(lambda: shape(editor, 'Step Fill'), 'the old name')
    assert editor.save(path) == TANK


def found(screen):
    """find and replace reach steps, conditions and the rungs of actions"""
    path, editor = opened(screen)
    editor.keys('ctrl+f')
    editor.type('heat')
    editor.keys('Return')
    at(editor, 'from Fill to Heat')
    editor.shot('chart-found')
    editor.focus_on('Find', 'text')
    editor.keys('Return')
    at(editor, 'Step Heat')
    editor.keys('Escape')
    on_chart(editor)
    editor.keys('F3')
    at(editor, 'from Heat to Idle')
    editor.keys('shift+F3')
    at(editor, 'Step Heat')
    # Esc on the chart clears the selection first, then closes the bar.
    editor.keys('ctrl+f')
    editor.focus_on('Find', 'text')
    editor.click(upon(editor, shape(editor, 'Step Heat')))
    on_chart(editor)
    editor.keys('Escape')
    until(lambda: not [node for node in editor.all('Find', 'text') if node.name == 'Find'], 'the bar to be closed')
    # Next hit: the rung of an action opens below the chart and gets the keys.
    editor.keys('ctrl+f')
    editor.type('MX1')
    editor.keys('Return')
    until(lambda: editor.all('Action Counting', 'label'), 'the heading of the action')
    editor.element('MX1.0')
    editor.shot('chart-found-rung')
    editor.focus_on('Find', 'text')
    editor.keys('Escape')
    until(lambda: editor.sheet().has(12), 'the focus on the rung')
    # Replace all: in rungs, lines and declarations, as one step of the history.
    editor.keys('ctrl+h', 'ctrl+a')
    editor.type('Count')
    line = until(lambda: editor.all('Replace with', 'text'), 'the second line')[0]
    editor.click(line)
    until(lambda: line.has(12), 'the focus in the second line')
    editor.type('Number')
    until(lambda: editor.all('Replace all', 'push button'), 'the button')[0].press()
    shape(editor, 'does: P1 Numbering')
    text = editor.save(path)
    assert 'Count' not in text and 'ACTION Numbering:' in text and 'IN1:=Number' in text, text
    check(path)
    editor.click(upon(editor, shape(editor, 'Step Idle')))
    on_chart(editor)
    editor.keys('ctrl+z')
    shape(editor, 'does: P1 Counting')
    assert editor.save(path) == TANK


def folded(screen):
    """a macro-step is made and dissolved; priorities; comments"""
    path, editor = opened(screen)
    go(editor, 'Heat')
    editor.keys('ctrl+shift+Down')
    at(editor, 'Step Macro1')
    shape(editor, 'Step Heat, initial')
    editor.shot('chart-macro')
    text = editor.save(path)
    assert '  MACRO_STEP Macro1:\n    INITIAL_STEP Heat:\n    END_STEP\n  END_STEP\n' in text, text
    check(path)
    # A selection that cannot be a macro-step is refused with the reason; nothing changes.
    go(editor, 'Idle')
    editor.keys('ctrl+shift+Down')
    editor.says('the initial step cannot go into a macro-step')
    # Dissolved again, by the menu.
    menu(editor, shape(editor, 'Step Heat, initial'), 'Take out of the macro-step')
    until(lambda: not editor.all('Step Macro1', 'table cell'), 'the macro-step to be gone')
    text = editor.save(path)
    assert text == TANK, text
    on_chart(editor)
    editor.keys('ctrl+z')
    shape(editor, 'Step Macro1')
    editor.keys('ctrl+z')
    until(lambda: not editor.all('Step Macro1', 'table cell'), 'the macro-step to be gone')
    # The priority: which transition is evaluated first.
    editor.click(upon(editor, shape(editor, 'from Fill to Idle')))
    at(editor, 'from Fill to Idle')
    asked(editor, 'ctrl+shift+p', '1')
    text = editor.save(path)
    assert 'TRANSITION (PRIORITY := 1) FROM Fill TO Idle' in text, text
    asked(editor, 'ctrl+shift+p', '')
    assert editor.save(path) == TANK
    menu(editor, shape(editor, 'from Fill to Heat'), 'Transition priority')
    editor.opened()
    editor.entry('2')
    on_chart(editor)
    shape(editor, 'from Fill to Heat')
    # Comments of all three.
    asked(editor, 'semicolon', 'until it is full')
    shape(editor, 'from Fill to Heat', 'until it is full')
    go(editor, 'Heat')
    asked(editor, 'semicolon', 'steam')
    shape(editor, 'Step Heat', 'steam')
    menu(editor, shape(editor, 'does: N Valve'), 'Step or transition comment')
    editor.opened()
    editor.entry('the inlet')
    shape(editor, 'does: N Valve', 'the inlet')
    editor.shot('chart-comments')
    text = editor.save(path)
    for line in ('  (* until it is full *)\n  TRANSITION (PRIORITY := 2) FROM Fill TO Heat', '  (* steam *)\n  STEP Heat:',
                 '    (* the inlet *)\n    Valve(N);'):
        assert line in text, (line, text)
    check(path)


def far(screen):
    """a chart larger than the window scrolls to the shape that the cursor goes to, and has the focus"""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../../ladders/washing-machine.rung')) as file:
        path = new_file(screen, file.read())
    editor = Editor(screen, path)
    shape(editor, 'Step Standby')
    # Only visible shapes are accessible children.
    for step in ('Blocked', 'Standby', 'Stuck'):
        go(editor, step)
    editor.keys('ctrl+f')
    editor.type('DrumRight')
    editor.keys('Return')
    editor.says('4 of 4')
    until(lambda: [node for node in editor.all('DrumRight', 'table cell') if node.has(23)], 'what is found')
    editor.shot('chart-far')
    editor.keys('Escape')
    on_chart(editor)


TWO = '''RUNGBOARD 1

PROGRAM Main SFC
  INITIAL_STEP Idle:
    One(N);
    Two(N);
  END_STEP

  TRANSITION FROM Idle TO Idle:
  END_TRANSITION

  ACTION One:
    RUNG
      | NO %IX0.0 | COIL %QX0.0 |
  END_ACTION

  ACTION Two:
    RUNG
      | NO %IX0.1 | COIL %QX0.1 |
  END_ACTION
END_PROGRAM
'''


def enter(editor, text):
    """Opens the body below, or an entry, by a click and a key. Clicks again after a pause: under X11 GTK 4.8 loses
    some clicks where a popover was."""
    def look():
        editor.click(upon(editor, shape(editor, text)))
        try:
            return until(lambda: shape(editor, text).has(23), 'the cursor', 2)
        except AssertionError:
            return False
    until(look, 'the cursor at ' + text)
    on_chart(editor)
    editor.keys('Return')


def numbered(screen):
    """rungs below a chart keep their numbers and their action when rungs above are added and removed"""
    path = new_file(screen, TWO)
    editor = Editor(screen, path)
    shape(editor, 'Step Idle, initial')
    enter(editor, 'Idle does: N One')
    until(lambda: editor.all('Action One', 'label'), 'the heading of the action')
    editor.to_sheet()
    editor.keys('Insert')
    editor.entry('Q0.2')
    editor.element('Rung 2', 'QX0.2')
    editor.to_sheet()
    enter(editor, 'Idle does: N Two')
    until(lambda: editor.all('Action Two', 'label'), 'the heading of the other action')
    editor.element('Rung 3', 'QX0.1')
    # A new condition is one more rung above.
    enter(editor, 'from Idle to Idle')
    editor.opened()
    editor.entry('I0.2')
    on_chart(editor)
    editor.element('Rung 4', 'QX0.1')
    editor.find('Action Two')
    # Removed again, then the other action's rung.
    on_chart(editor)
    editor.keys('ctrl+z')
    editor.element('Rung 3', 'QX0.1')
    for _ in range(3):
        editor.keys('ctrl+z')
    # Undo shows the body that it changed.
    until(lambda: editor.all('Action One', 'label'), 'the heading of the action')
    until(lambda: not editor.all('Rung 2', 'table cell'), 'the rung to be gone')
    enter(editor, 'Idle does: N Two')
    until(lambda: editor.all('Action Two', 'label'), 'the heading of the other action')
    editor.element('Rung 2', 'QX0.1')
    editor.shot('chart-numbers')
    time.sleep(1.8)  # longer than a message stays: closing the body must not tell anything now


def declared(screen):
    """new names in conditions and behind qualifiers are declared, with the typed or the chosen type"""
    path, editor = opened(screen)
    enter(editor, 'from Heat to Idle')
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('Level AT %IW2 : INT > 80 AND Ready')
    editor.says('new: Level AT %IW2 : INT; new: Ready AT %IX0.3 : BOOL')
    editor.candidate('Ready, new %MX0.0 BOOL')
    editor.shot('chart-declares')
    editor.keys('Return')
    editor.gone()
    shape(editor, 'from Heat to Idle, condition Level > 80 AND Ready')
    go(editor, 'Heat')
    editor.keys('F9')
    editor.opened()
    editor.type('Z Horn')
    editor.says('the first word is not a qualifier')
    editor.keys('ctrl+a')
    editor.type('N Horn AT %IX0.5')
    editor.says('“%IX0.5” cannot be written')
    editor.keys('Return')
    assert editor.asked()[0].text() == 'N Horn AT %IX0.5'
    editor.keys('ctrl+a')
    editor.type('L T#3s Horn AT %q')
    editor.candidate('Horn, new %QX0.1 BOOL')
    editor.shot('chart-declares-output')
    editor.keys('Down', 'Tab')
    until(lambda: editor.asked()[0].text() == 'L T#3s Horn AT %QX0.1', 'the address in the line')
    editor.keys('Return')
    editor.gone()
    shape(editor, 'Heat does: L T#3s Horn')
    text = editor.save(path)
    for wanted in 'Level AT %IW2   : INT;', 'Ready AT %IX0.3 : BOOL;', 'Horn  AT %QX0.1 : BOOL;':
        assert '  %s\n' % wanted in text, (wanted, text)
    assert 'FROM Heat TO Idle := Level > 80 AND Ready;' in text, text
    check(path)
    # A wrong step name is reported at once; an unknown one is allowed, since the step may follow.
    enter(editor, 'from Heat to Idle')
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('Later.X')
    editor.says('“Later.X” is not declared')
    editor.keys('Escape')
    editor.gone()
    on_chart(editor)
    editor.keys('ctrl+z', 'ctrl+z')
    shape(editor, 'from Heat to Idle, condition Hot AND Fill.T > T#1s')
    assert editor.save(path) == TANK


main([declared, renamed, found, folded, far, numbered])
