#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Networks of a function block diagram are drawn by keyboard alone and by pointer alone; undo, live values, find,
problems at the pin."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, sh, until  # noqa: E402
from screen import pixels  # noqa: E402

HEAD = '''RUNGBOARD 1

VAR
  Stop  AT %IX0.0 : BOOL;
  Ready AT %IX0.1 : BOOL;
  Valve AT %QX0.0 : BOOL;
  Level : REAL;
END_VAR

PROGRAM Main FBD
'''
EMPTY = HEAD + 'NETWORK\nEND_PROGRAM\n'
FILL = HEAD.replace('FBD\n', 'FBD\nVAR\n  Delay : TON;\nEND_VAR\n') + '''NETWORK Fill "Fill the tank while there is room"
  Low := LT(IN1 := Level, IN2 := 20.0)
  Delay(IN := Low AND NOT Stop AND Ready, PT := T#3s)
  Valve := Delay.Q
NETWORK "Not used yet"
  Room := Level + 5.0
END_PROGRAM
'''


INDEX = '''RUNGBOARD 1

VAR
  T : ARRAY[0..9] OF INT;
  I AT %IW2 : INT;
END_VAR

PROGRAM Main FBD
NETWORK
  Low := I + 1
  T[Low] := T[T[Low]]
NETWORK
  Low := I
  T[Low] := 1
END_PROGRAM
'''


def sheet(editor):
    return until(lambda: [node for node in editor.all('Networks') if node.name == 'Networks'], 'the networks')[0]


def part(editor, name):
    """The heading, box or pin with exactly this name."""
    def look():
        found = [node for node in editor.all(role='table cell') if node.name == name]
        return found[0] if found else None
    return until(look, 'what is called ' + name)


def at(editor, name):
    """Waits until the cursor is there."""
    until(lambda: part(editor, name).has(23), 'the cursor at ' + name)


def on_sheet(editor):
    until(lambda: sheet(editor).has(12), 'the focus on the networks')


def typed(editor, text):
    """Types into the entry that the first letter opens."""
    on_sheet(editor)
    editor.type(text[0])
    editor.opened()
    editor.entry(text[1:])
    on_sheet(editor)


def asked(editor, key, text):
    on_sheet(editor)
    editor.keys(key)
    editor.opened()
    editor.entry(text)
    on_sheet(editor)


def by_keyboard(screen):
    """by the keyboard alone"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    at(editor, 'Network 1')
    typed(editor, 'LT')
    at(editor, 'LT, executed as number 1')
    editor.keys('Left')
    at(editor, 'LT, input IN1: open')
    typed(editor, 'Level')
    at(editor, 'LT, input IN1: Level')
    editor.keys('Down')
    at(editor, 'LT, input IN2: open')
    typed(editor, '20.0')
    at(editor, 'LT, input IN2: 20.0')
    editor.keys('Right')
    at(editor, 'LT, executed as number 1')
    typed(editor, 'AND')
    at(editor, 'AND, executed as number 2')
    editor.keys('ctrl+i')
    part(editor, 'AND, input IN3: open')
    at(editor, 'AND, executed as number 2')
    editor.keys('Left', 'Down')
    at(editor, 'AND, input IN2: open')
    typed(editor, 'Stop')
    at(editor, 'AND, input IN2: Stop')
    editor.keys('slash')
    at(editor, 'AND, input IN2, negated: Stop')
    editor.keys('Down')
    at(editor, 'AND, input IN3: open')
    typed(editor, 'Ready')
    at(editor, 'AND, input IN3: Ready')
    editor.keys('Right')
    at(editor, 'AND, executed as number 2')
    typed(editor, 'TON')
    at(editor, 'TON Delay1, executed as number 3')
    editor.keys('Left', 'Down')
    at(editor, 'TON Delay1, input PT: open')
    typed(editor, '3s')
    at(editor, 'TON Delay1, input PT: T#3s')
    editor.keys('Right')
    at(editor, 'TON Delay1, executed as number 3')
    asked(editor, 'F7', 'Valve')
    at(editor, 'Store in Valve')
    asked(editor, 'ctrl+shift+t', 'Fill the tank')
    part(editor, 'Network 1, Fill the tank')
    editor.shot('fbd-keyboard')
    text = editor.save(path)
    for line in ('NETWORK "Fill the tank"', ' := LT(IN1 := Level, IN2 := 20.0)', ', IN2 := NOT Stop, IN3 := Ready)',
                 'PT := T#3s)', 'Valve := Delay1.Q', 'Delay1 : TON;'):
        assert line in text, (line, text)
    check(path)
    editor.finish()


def menu(editor, node, verb):
    """By its accessible action: the places of rows of a menu are not known."""
    editor.click(node, button=3)
    until(lambda: editor.all(verb, 'menu item'), 'the menu')[0].press()


def aims(screen):
    """while a word of the palette is dragged, a dashed frame shows its place; the cursor stays where it is until the drop"""
    accent = (0x1a, 0x5f, 0xb4)
    text = FILL.replace(' Fill "Fill the tank while there is room"', '').replace(' "Not used yet"', '')
    editor = Editor(screen, new_file(screen, text))
    box = until(lambda: [node for node in editor.all('TON Delay, executed', role='table cell')], 'the timer')[0]
    editor.click(part(editor, 'Network 2'))
    at(editor, 'Network 2')
    x, y, width, height = editor.place(box)
    edge = lambda: pixels(x - 12, y, 24, height).count(accent)

    def held():
        return part(editor, 'Network 2').has(23) and edge() >= 8
    editor.drag(editor.tile('TOF: '), (x + width // 2, y + height - 8), look='fbd-aims', ready=held)
    until(lambda: [node for node in editor.all('TOF Delay', role='table cell')], 'the box')
    editor.keys('ctrl+z')
    until(lambda: not editor.all('TOF Delay', role='table cell'), 'the box to be gone')
    # Beside the sheet the drop means nothing, and nothing stays marked.
    editor.click(part(editor, 'Network 2'))
    at(editor, 'Network 2')
    start = editor.centre(editor.tile('TOF: '))
    sh('xdotool', 'mousemove', str(start[0]), str(start[1]), 'mousedown', '1', 'mousemove', str(start[0] + 30), str(start[1]), 'sleep', '0.2',
       'mousemove', str(x + width // 2), str(y + height - 9), 'sleep', '0.2', 'mousemove', str(x + width // 2), str(y + height - 8))
    until(held, 'the frame')
    sh('xdotool', 'mousemove', str(start[0] + 40), str(start[1]), 'sleep', '0.2', 'mousemove', str(start[0] + 41), str(start[1]), 'sleep', '0.2', 'mouseup', '1')
    until(lambda: edge() == 0, 'the frame to be gone')
    at(editor, 'Network 2')
    assert not editor.all('TOF Delay', role='table cell')


def by_pointer(screen):
    """by the pointer alone: boxes from the palette, wires from pin to pin, symbols from the menu"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    editor.drag(editor.tile('TON: '), part(editor, 'Network 1'), look='fbd-drop')
    at(editor, 'TON Delay1, executed as number 1')
    editor.click(part(editor, 'Network 1'))
    at(editor, 'Network 1')
    editor.click(editor.tile('TOF: '))
    at(editor, 'TOF Delay2, executed as number 2')
    editor.drag(part(editor, 'TON Delay1, output Q: open'), part(editor, 'TOF Delay2, input IN: open'), look='fbd-wire')
    part(editor, 'TOF Delay2, input IN: wire')
    menu(editor, part(editor, 'TON Delay1, input IN: open'), 'Ready')
    part(editor, 'TON Delay1, input IN: Ready')
    menu(editor, part(editor, 'TON Delay1, input IN: Ready'), 'Negate the pin')
    part(editor, 'TON Delay1, input IN, negated: Ready')
    # A box in the wire, and a place for it.
    editor.click(part(editor, 'TOF Delay2, input IN: wire'))
    at(editor, 'TOF Delay2, input IN: wire')
    editor.click(editor.tile('TP: '))
    at(editor, 'TP Delay3, executed as number 2')
    box = part(editor, 'TOF Delay2, executed as number 3')
    before = editor.place(box)
    editor.drag(editor.centre(box), (editor.centre(box)[0] + 150, editor.centre(box)[1] + 90), look='fbd-move')
    until(lambda: editor.place(part(editor, 'TOF Delay2, executed as number 3'))[1] > before[1], 'the box to be lower')
    menu(editor, part(editor, 'TP Delay3, output Q: wire'), 'Negate the pin')
    part(editor, 'TP Delay3, output Q, negated: wire Wire1')
    editor.shot('fbd-pointer')
    text = editor.save(path)
    for line in ('Delay1(IN := NOT Ready)', 'Delay3(IN := Delay1.Q, NOT Q => Wire1)', 'Delay2(IN := Wire1)  { at '):
        assert line in text, (line, text)
    editor.finish()


def changes(screen):
    """delete, copy, paste, undo and redo; networks are added, moved and switched off; a wire by two keys"""
    path = new_file(screen, FILL)
    editor = Editor(screen, path)
    at(editor, 'Network 1, Fill, Fill the tank while there is room')
    editor.click(part(editor, 'AND, executed as number 2'))
    at(editor, 'AND, executed as number 2')
    editor.keys('Delete')
    part(editor, 'TON Delay, input IN: open')
    editor.keys('ctrl+z')
    part(editor, 'AND, input 2, negated: Stop')
    editor.keys('ctrl+y')
    part(editor, 'TON Delay, input IN: open')
    # From the output of LT to the input of the timer.
    editor.click(part(editor, 'LT, output OUT: wire Low'))
    at(editor, 'LT, output OUT: wire Low')
    editor.keys('F6')
    editor.click(part(editor, 'TON Delay, input IN: open'))
    at(editor, 'TON Delay, input IN: open')
    editor.keys('F6')
    part(editor, 'TON Delay, input IN: wire Low')
    editor.click(part(editor, '+, executed as number 1'))
    at(editor, '+, executed as number 1')
    editor.keys('ctrl+c', 'ctrl+v')
    part(editor, '+, executed as number 2')
    part(editor, '+, output 1: wire Wire1')
    editor.keys('Insert')
    at(editor, 'Network 3')
    editor.keys('alt+Up')
    at(editor, 'Network 2')
    editor.keys('ctrl+slash')
    at(editor, 'Network 2, off')
    asked(editor, 'ctrl+l', 'Later')
    at(editor, 'Network 2, Later, off')
    text = editor.save(path)
    for line in ('Delay(IN := Low, PT := T#3s)', 'NETWORK OFF Later\nNETWORK "Not used yet"', '  Wire1 := Level + 5.0\n'):
        assert line in text, (line, text)
    editor.keys(*['ctrl+z'] * 7)
    part(editor, 'AND, input 2, negated: Stop')
    text = editor.save(path)
    assert text == FILL, text
    editor.finish()


def shown(screen):
    """a problem is told at its pin, find goes to a box, values are shown while the program runs"""
    path = new_file(screen, FILL.replace('Level + 5.0', 'MAX(Level, 7.5) + Nothing'))
    editor = Editor(screen, path)
    at(editor, 'Network 1, Fill, Fill the tank while there is room')
    until(lambda: editor.all('"Nothing" is not declared'), 'the problem')
    until(lambda: editor.all('Main, network 2'), 'its place')
    editor.keys('ctrl+period')
    at(editor, '+, input 2: Nothing')
    editor.shot('fbd-problem')
    editor.keys('Return')
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('5.0')
    at(editor, '+, input 2: 5.0')
    editor.keys('ctrl+f')
    editor.focus_on('Find')
    editor.type('Delay.Q')
    editor.keys('Return', 'Escape')
    on_sheet(editor)
    at(editor, 'Store in Valve, input 1: wire')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    part(editor, 'LT, input IN1: Level, 0')
    part(editor, 'LT, output OUT: wire Low, TRUE')
    part(editor, 'AND, input 2, negated: Stop, FALSE')
    part(editor, 'Store in Valve, FALSE')
    part(editor, 'MAX, output OUT: wire, 7.5')
    until(lambda: editor.all('Low.N1'), 'the wire in the panel')
    at(editor, 'Store in Valve, input 1: wire, FALSE')
    editor.keys('ctrl+F12')
    until(lambda: editor.all('FALSE: Delay.Q is FALSE · Delay.IN FALSE: Ready is FALSE'), 'why the valve is shut')
    ready = [node for node in editor.all('Ready', 'check box') if node.box()[2] > 0][0]
    editor.click(ready)
    until(lambda: not editor.all('Ready is FALSE'), 'the reason to follow the values')
    until(lambda: editor.all('Delay.IN TRUE'), 'what holds now')
    editor.click(ready)
    until(lambda: editor.all('Delay.IN FALSE: Ready is FALSE'), 'the reason to follow back')
    editor.click(part(editor, 'AND, input 3: Ready, FALSE'))
    at(editor, 'AND, input 3: Ready, FALSE')
    until(lambda: not editor.all('Ready is FALSE'), 'the reason to go when the cursor moves')
    editor.keys('ctrl+shift+f')
    part(editor, 'AND, input 3: Ready, TRUE')
    part(editor, 'Store in Valve, TRUE')
    editor.shot('fbd-live')
    # Space changes a variable, also when it is pressed quickly; a result that no variable has stays.
    stop = 'AND, input 2, negated: Stop, '
    editor.click(part(editor, stop + 'FALSE'))
    at(editor, stop + 'FALSE')
    on_sheet(editor)
    editor.keys('space')
    part(editor, stop + 'TRUE')
    editor.keys('space', 'space', 'space')
    part(editor, stop + 'FALSE')
    editor.click(part(editor, 'LT, output OUT: wire Low, TRUE'))
    at(editor, 'LT, output OUT: wire Low, TRUE')
    on_sheet(editor)
    editor.keys('space')
    editor.says('Nothing at the cursor has a value that can be set.')
    editor.finish()


def pasted(screen):
    """a copy of a block gets an instance of its own, in one step; one that was cut keeps its instance"""
    path = new_file(screen, FILL)
    editor = Editor(screen, path)
    at(editor, 'Network 1, Fill, Fill the tank while there is room')
    editor.click(part(editor, 'TON Delay, executed as number 3'))
    at(editor, 'TON Delay, executed as number 3')
    editor.keys('ctrl+c', 'ctrl+v')
    part(editor, 'TON Delay1, executed as number 5')
    until(lambda: editor.all('New instances: Delay1 : TON'), 'what is declared')
    editor.shot('fbd-pasted')
    text = editor.save(path)
    assert 'Delay1 : TON;' in text and '  Delay1(IN := ' in text, text
    editor.keys('ctrl+z')
    until(lambda: not [node for node in editor.all(role='table cell') if 'Delay1' in node.name], 'one step back')
    assert editor.save(path) == FILL
    editor.click(part(editor, 'TON Delay, executed as number 3'))
    at(editor, 'TON Delay, executed as number 3')
    editor.keys('ctrl+x')
    until(lambda: not [node for node in editor.all(role='table cell') if 'TON' in node.name], 'the box to be cut')
    editor.keys('ctrl+v')
    until(lambda: [node for node in editor.all(role='table cell') if node.name.startswith('TON Delay, executed')], 'the box')
    text = editor.save(path)
    assert 'Delay1' not in text, text
    editor.finish()


def renamed(screen):
    """F2 renames a wire wherever its network reads it, also in an index, and not that of another network"""
    path = new_file(screen, INDEX)
    editor = Editor(screen, path)
    at(editor, 'Network 1')
    editor.click(part(editor, '+, output 1: wire Low'))
    at(editor, '+, output 1: wire Low')
    on_sheet(editor)
    editor.keys('F2')
    until(lambda: editor.all(role='dialog'), 'the dialog')
    editor.shot('fbd-rename')
    editor.focus_on(role='text')
    editor.keys('ctrl+a')
    editor.type('High')
    editor.keys('Return')
    part(editor, '+, output 1: wire High')
    text = editor.save(path)
    assert 'High := I + 1\n  T[High] := T[T[High]]\nNETWORK\n  Low := I\n  T[Low] := 1\n' in text, text
    editor.finish()


def first_row(editor, row, line):
    """Takes the row below the entry; then the entry has this line."""
    editor.candidate(row)
    editor.keys('Down', 'Tab')
    until(lambda: editor.asked() and editor.asked()[0].text() == line, 'the line ' + line)


def completed(screen):
    """the entry offers wires of the network, also inside of an expression, and R_EDGE, F_EDGE, PREVIOUS"""
    path = new_file(screen, FILL)
    editor = Editor(screen, path)
    at(editor, 'Network 1, Fill, Fill the tank while there is room')
    editor.click(part(editor, 'AND, input 3: Ready'))
    at(editor, 'AND, input 3: Ready')
    on_sheet(editor)
    editor.keys('Return')
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('Ready OR Lo')
    first_row(editor, 'Low', 'Ready OR Low')
    editor.shot('fbd-candidates')
    rows = [node.name for node in editor.all('Low', 'list item')]
    assert len(rows) == 1, 'a wire is no variable and no new name: %s' % rows
    editor.keys('Escape')
    editor.gone()
    on_sheet(editor)
    editor.keys('Return')
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('R_E')
    first_row(editor, 'R_EDGE(', 'R_EDGE(')
    editor.type('PREV')
    first_row(editor, 'PREVIOUS(', 'R_EDGE(PREVIOUS(')
    editor.type('L')
    first_row(editor, 'Low', 'R_EDGE(PREVIOUS(Low')
    editor.type('))')
    editor.keys('Return')
    editor.gone()
    part(editor, 'R_EDGE, executed as number 2')
    editor.click(part(editor, 'Network 2, Not used yet'))
    at(editor, 'Network 2, Not used yet')
    on_sheet(editor)
    editor.type('F')
    editor.opened()
    editor.type('_E')
    first_row(editor, 'F_EDGE', 'F_EDGE')
    editor.keys('Return')
    editor.gone()
    part(editor, 'F_EDGE, executed as number 3')
    text = editor.save(path)
    assert 'IN := Low AND NOT Stop AND R_EDGE(PREVIOUS(Low))' in text, text
    editor.finish()


def left(screen):
    """STOP, RETURN and JMP behind a box, alone, and with a condition; Stop is a variable"""
    path = new_file(screen, FILL)
    editor = Editor(screen, path)
    at(editor, 'Network 1, Fill, Fill the tank while there is room')
    for word, name in (('STOP', 'Stop the controller'), ('RETURN', 'Return'), ('JMP Fill', 'Jump to Fill')):
        editor.click(part(editor, 'AND, executed as number 2'))
        at(editor, 'AND, executed as number 2')
        typed(editor, word)
        at(editor, name)
    editor.click(part(editor, 'Network 2, Not used yet'))
    at(editor, 'Network 2, Not used yet')
    typed(editor, 'STOP IF Stop AND Ready')
    part(editor, 'AND, executed as number 2')
    editor.click(part(editor, 'Network 2, Not used yet'))
    at(editor, 'Network 2, Not used yet')
    typed(editor, 'RETURN')
    until(lambda: [node for node in editor.all('Return', 'table cell') if node.name == 'Return' and node.has(23)], 'a return without a condition')
    editor.click(part(editor, 'TON Delay, executed as number 3'))
    at(editor, 'TON Delay, executed as number 3')
    typed(editor, 'Stop')
    at(editor, 'Store in Stop')
    editor.shot('fbd-stop')
    text = editor.save(path)
    for line in ('  STOP IF Wire1\n', '  RETURN IF Wire1\n', '  JMP Fill IF Wire1\n', '  STOP IF Stop AND Ready\n  RETURN\n'):
        assert line in text, (line, text)
    # A box that stops reads another value.
    editor.click(part(editor, 'Network 2, Not used yet'))
    at(editor, 'Network 2, Not used yet')
    editor.keys('Insert')
    at(editor, 'Network 3')
    typed(editor, 'STOP')
    until(lambda: [node for node in editor.all('Stop the controller', 'table cell') if node.has(23)], 'a stop without a condition')
    editor.keys('Left')
    at(editor, 'Stop the controller, input 1: open')
    typed(editor, 'Ready')
    at(editor, 'Stop the controller, input 1: Ready')
    editor.keys('slash')
    at(editor, 'Stop the controller, input 1, negated: Ready')
    assert 'NETWORK\n  STOP IF NOT Ready\n' in editor.save(path)
    editor.finish()


if __name__ == '__main__':
    main([by_keyboard, by_pointer, aims, changes, shown, renamed, pasted, completed, left])
