#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""watch - a person makes a status chart, sees values in it, writes and forces them."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Chinese, Editor, main, new_file, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Level : INT;
  High  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Start | COIL Motor |
RUNG "High"
  | [ Level > 500 ] | COIL High |
END_PROGRAM
'''

BLOCKS = '''RUNGBOARD 1

FUNCTION_BLOCK Lift LD
VAR_INPUT
  In : BOOL;
END_VAR
VAR_OUTPUT
  Out : BOOL;
END_VAR
RUNG
  | NO In | COIL Out |
END_FUNCTION_BLOCK

PROGRAM Main LD
VAR
  First : Lift;
  Second : Lift;
END_VAR
RUNG
  | NO %IX0.0 | Lift First | COIL %QX0.0 |
RUNG
  | NO %IX0.1 | Lift Second | COIL %QX0.1 |
END_PROGRAM
'''

def chart(editor):
    """Shows the tab and adds names to the chart."""
    editor.to_sheet()
    editor.keys('ctrl+alt+w')
    editor.find('Add variables', 'push button')


def add(editor, names):
    editor.click(editor.find('Add variables', 'push button'))
    prompt = 'Names and addresses, such as Motor %IW0 %Q0..7'
    editor.find(prompt, 'text')
    editor.type(names)
    editor.keys('Return')
    until(lambda: not editor.all(prompt, 'text'), 'the line to be gone')


def shows(editor, text):
    """The text of a value cell."""
    return until(lambda: [node for node in editor.all(role='label') if node.name == text], 'the value ' + text)


def values(screen):
    """names are typed, values are live, new values are written at once, the file has the chart"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    chart(editor)
    editor.shot('watch-first')
    add(editor, 'Level Nobody')
    editor.find('"Nobody" is not declared in the program')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.into('Level, New value')
    editor.type('16#3E7')
    editor.into('Start, New value')
    editor.type('1')
    editor.shot('watch-typed')
    editor.click(editor.find('Write all new values', 'push button'))
    shows(editor, '999')
    editor.shot('watch-written')
    editor.into('Level, New value')
    editor.type('70000')
    editor.keys('Return')
    editor.find('constant is out of range')
    editor.keys('ctrl+a')
    editor.type('12')
    editor.keys('Return')
    shows(editor, '12')
    editor.click(editor.find('Level, Shown as'))
    editor.find('Hexadecimal', 'menu item').press()
    shows(editor, '16#000C')
    editor.click(editor.find('Add variables', 'push button'))
    editor.find('Names and addresses, such as Motor %IW0 %Q0..7', 'text')
    editor.type('evel')
    editor.find('Level', 'list item')
    editor.keys('Escape', 'Escape')
    text = editor.save(path)
    assert '  status-chart Chart 1\n    watch auto Start\n    watch hex Level\n' in text, text
    assert '    watch auto Nobody\n' in text, text


PHASES = '''RUNGBOARD 1

TYPE
  Phase : (Idle, Hot := 5, Cold);
END_TYPE

VAR
  Now : Phase;
  Lamp AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | [ Now = Hot ] | COIL Lamp |
RUNG
  | NO Lamp | [ Now := Phase#Hot ] |
END_PROGRAM
'''


def named(screen):
    """values of enumerations have their names in the chart, the panel and the sheet, where they are typed, too"""
    editor = Editor(screen, new_file(screen, PHASES))
    chart(editor)
    add(editor, 'Now')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.element('Rung 1, [ ]', 'Idle = Hot, open')
    until(lambda: len([node for node in editor.all(role='label') if node.name == 'Idle' and node.box()[2] > 0]) == 2,
          'the name in the chart and in the panel')
    editor.into('Now, New value')
    editor.type('hot')
    editor.keys('Return')
    editor.element('Rung 1, [ ]', 'Hot = Hot, closed')
    until(lambda: len([node for node in editor.all(role='label') if node.name == 'Hot' and node.box()[2] > 0]) == 2, 'the other name')
    editor.shot('watch-named')
    editor.into('Now, New value')
    editor.type('Warm')
    editor.keys('Return')
    editor.find('Not a value of type Phase: Idle, Hot, Cold')
    editor.keys('ctrl+a', 'BackSpace')
    editor.click(editor.middle(editor.element('Rung 1, [ ]', 'Hot = Hot')), count=2)
    until(lambda: [node for node in editor.asked() if node.text() == 'Hot'], 'the entry with the name')
    editor.keys('ctrl+a')
    editor.type('Phase#Cold')
    editor.keys('Return')
    editor.element('Rung 1, [ ]', 'Cold = Hot, open')
    editor.says('Now = Cold')


def dragged(screen):
    """elements of the sheet are dragged onto both charts: their variables are in them and in the file"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    chart(editor)
    x, y = editor.centre(editor.find('Add variables', 'push button'))
    editor.drag(editor.middle(editor.element('Rung 1, COIL', 'Motor')), (x + 200, y + 90), look='watch-drag')
    editor.find('Motor, New value')
    editor.drag(editor.middle(editor.element('Rung 2, [ ]', 'Level')), (x + 200, y + 90))
    editor.find('Level, Shown as')
    editor.shot('watch-dragged')
    editor.tab('Timing chart')
    area = editor.find('Timing chart, cursor')
    editor.drag(editor.middle(editor.element('Rung 2, COIL', 'High')), editor.centre(area))
    until(lambda: editor.save(path) and '  timing High\n' in open(path).read(), 'the variable in the chart')
    editor.shot('watch-dragged-chart')
    text = open(path).read()
    assert '  status-chart Chart 1\n    watch auto Start\n    watch auto Motor\n    watch auto Level\n' in text, text
    assert text.startswith(PROGRAM), 'the program is another one'
    editor.keys('ctrl+r')
    editor.says('SIMULATION')


def forces(screen):
    """F forces a value against the program and releases it; a row is moved and removed"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    chart(editor)
    add(editor, 'Motor')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.into('Motor, New value')
    editor.type('1')
    editor.click(editor.find('Motor, Force'))
    editor.find('1 force', 'push button')
    shows(editor, '1')
    editor.shot('watch-forced')
    editor.click(editor.find('Motor, Force'))
    until(lambda: not editor.all('1 force', 'push button'), 'the force to be gone')
    editor.click(editor.find('Move the row up', 'push button'))
    text = editor.save(path)
    assert '    watch auto Motor\n    watch auto Start\n' in text, text
    editor.click(editor.find('Remove the row', 'push button'))
    text = editor.save(path)
    assert 'Motor\n    watch' not in text and '    watch auto Start\n' in text, text


def chinese(screen):
    """a chart of Chinese names, dark, small"""
    path = new_file(screen, PROGRAM.replace('Start', '\u542f\u52a8').replace('Level', '\u6db2\u4f4d'))
    editor = Chinese(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    chart(editor)
    add(editor, '\u6db2\u4f4d Motor %QW0')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    until(lambda: [node for node in editor.all(role='label') if node.name == '%QW0'], 'the rows')
    shows(editor, '0')
    editor.shot('watch-chinese')


chinese.size = '1024x700x24'
def last_letter(screen):
    """close right behind the last letter of a comment: it is in the file; a new value that was not written is dropped"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    chart(editor)
    add(editor, 'Level')
    saved = editor.save(path)
    editor.into('Level, New value')
    editor.type('7')
    editor.into('Level, Comment')
    editor.type('of the tank')
    editor.keys('ctrl+w')
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the window to close')
    assert open(path).read() == saved.replace('watch auto Level\n', 'watch auto Level of the tank\n'), open(path).read()


def block(screen):
    """a name in a function block is added with its instance, before a simulation and for the chosen instance in it"""
    path = new_file(screen, BLOCKS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+alt+w')
    editor.find('Main.First.In, New value')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'In')), button=3)
    editor.find('Second', 'menu item').press()
    until(lambda: [node for node in editor.all('Second', 'label') if 'Rung 1' in node.name], 'the instance')
    editor.keys('ctrl+alt+w')
    editor.find('Second.In, New value')
    editor.shot('watch-block')
    assert '    watch auto Main.First.In\n    watch auto Second.In\n' in editor.save(path), open(path).read()


main([values, named, dragged, forces, chinese, last_letter, block])
