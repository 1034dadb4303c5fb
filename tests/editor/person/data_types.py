#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""data_types - a person makes structures and arrays, gives them initial values, and looks at the address map."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, check, lines, main, new_file, sh, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

TYPE
  Bounds : STRUCT
    Low  : INT := 10;
    High : INT;
  END_STRUCT;
END_TYPE

VAR
  Limit : Bounds := (High := 90);
  Level : INT;
END_VAR

PROGRAM Main LD
RUNG
  | [ Level > Limit.High ] | COIL %QX0.0 |
END_PROGRAM
'''


def label(editor, text):
    return until(lambda: editor.all(text, 'label'), 'the text "%s"' % text)[0]


def seen(editor, name, role='text'):
    """The visible one."""
    return until(lambda: [node for node in editor.all(name, role) if node.box()[2] > 0], name)[0]


def ordered(editor, *names):
    def rows():
        tops = [(node.box()[1], name) for name in names for node in editor.all(name + ', Name', 'text') if node.box()[2] > 0]
        return [name for _, name in sorted(tops)]
    until(lambda: rows() == list(names), 'the order ' + ' '.join(names))


def structure(screen):
    """a structure is made, its members typed, moved by keys and by pointer, renamed everywhere, duplicated; each undoes"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.command('New data type')
    until(lambda: editor.all(role='dialog'), 'the question for a name')
    editor.keys('ctrl+a')
    editor.type('Bounds')
    label(editor, '“Bounds” is declared already')
    editor.keys('ctrl+a')
    editor.type('Recipe')
    until(lambda: not editor.all('is declared already', 'label'), 'no refusal')
    editor.keys('Return')
    editor.focus_on('Member1, Name', 'text')
    editor.type('Speed')
    editor.keys('Tab', 'ctrl+a')
    editor.type('UI')
    until(lambda: editor.find('Speed, Type', 'text').text() == 'UINT', 'the rest of the word')
    editor.keys('Tab')
    editor.type('100')
    editor.keys('Tab')
    editor.type('rpm')
    editor.keys('Return')
    editor.click(editor.find('Add a member or value', 'push button'))
    editor.focus_on('Speed2, Name', 'text')
    editor.type('Limit')
    editor.keys('Tab', 'ctrl+a')
    editor.type('Bou')
    until(lambda: seen(editor, 'Limit, Type').text() == 'Bounds', 'the name of the other structure')
    editor.keys('Return')
    text = editor.save(path)
    made = '  Recipe : STRUCT\n    Speed : UINT := 100; (* rpm *)\n    Limit : Bounds;\n  END_STRUCT;\n'
    assert made in text, text
    check(path)
    editor.keys('alt+Up')
    ordered(editor, 'Limit', 'Speed')
    editor.focus_on('Limit, Type', 'text')
    editor.keys('alt+Down')
    ordered(editor, 'Speed', 'Limit')
    editor.shot('types-members')
    editor.drag(editor.centre(editor.find('Move Limit')), editor.centre(editor.find('Speed, Name', 'text')))
    ordered(editor, 'Limit', 'Speed')
    assert '    Limit : Bounds;\n    Speed : UINT := 100; (* rpm *)\n' in editor.save(path)
    editor.keys('ctrl+z')
    ordered(editor, 'Speed', 'Limit')
    editor.into('Speed, Type')
    editor.keys('ctrl+a')
    editor.type('Nothing')
    editor.keys('Return')
    label(editor, 'Speed, Type: ')
    editor.keys('alt+Down')
    assert editor.focus_on('Speed, Type', 'text').text() == 'Nothing'
    label(editor, 'Speed, Type: ')
    editor.keys('Escape')
    editor.click(editor.find('Duplicate the type', 'push button'))
    until(lambda: editor.all(role='dialog'), 'the question for a name')
    editor.keys('Return')
    until(lambda: editor.all('Recipe2', 'label'), 'the copy')
    text = editor.save(path)
    assert made + made.replace('Recipe', 'Recipe2') in text, text
    check(path)


def completed(screen):
    """the name of a type is completed in any spelling of its letters"""
    path = new_file(screen, PROGRAM.replace('Bounds', 'Öfen'))
    editor = Editor(screen, path)
    editor.command('New data type')
    until(lambda: editor.all(role='dialog'), 'the question for a name')
    editor.keys('Return')
    editor.focus_on('Member1, Name', 'text')
    editor.type('Limit')
    editor.keys('Tab', 'ctrl+a')
    editor.type('öf')
    until(lambda: seen(editor, 'Limit, Type').text() == 'öfen', 'the rest of the name')
    editor.keys('Return')
    editor.save(path)
    check(path)


def everywhere(screen):
    """a structure and a member get other names, also in initial values; a used one is deleted after a question"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.click(editor.find('Bounds', 'label'), count=2)
    editor.focus_on('Low, Name', 'text')
    editor.into('High, Name')
    editor.keys('ctrl+a')
    editor.type('Top')
    editor.keys('Return')
    text = editor.save(path)
    assert 'Limit : Bounds := (Top := 90);' in text and 'Level > Limit.Top' in text, text
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Span')
    editor.keys('Return')
    label(editor, '2 places changed')
    text = editor.save(path)
    assert '  Span : STRUCT\n' in text and 'Limit : Span := (Top := 90);' in text, text
    check(path)
    editor.focus_on('Top, Name', 'text')
    editor.keys('shift+F12')  # at once: the page may still have the old name
    until(lambda: editor.all('type', 'table row'), 'the uses')
    editor.click(editor.find('Delete the type', 'push button'))
    label(editor, 'It is used in 1 place. Variables and members of this type are deleted, too.')
    editor.shot('types-delete')
    editor.answer('Delete anyway')
    until(lambda: editor.all('No data types', 'label'), 'the empty page')
    text = editor.save(path)
    assert 'TYPE' not in text and 'Limit :' not in text and 'Level : INT' in text, text
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    assert editor.save(path) == PROGRAM


def array(screen):
    """an array is made without knowing how it is written; wrong bounds are refused at the entry; its values get a form"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    editor.into('Level, Type')
    editor.keys('ctrl+space')
    until(lambda: editor.all('Array…', 'push button'), 'the button')[0].press()
    last = until(lambda: editor.all('Last index', 'text'), 'the form of the array')[0]
    editor.keys('ctrl+a')
    editor.type('1')
    editor.keys('Tab')
    until(lambda: last.has(12), 'the focus on the last index')
    editor.keys('ctrl+a')
    editor.type('0')
    label(editor, 'The last index is below the first')
    editor.shot('types-array')
    editor.keys('ctrl+a')
    editor.type('6')
    editor.keys('Return')
    assert '  Level : ARRAY[1..6] OF INT;\n' in editor.save(path)
    # Bounds that are written as expressions stay what they are; Escape changes nothing.
    editor.into('Level, Type')
    editor.keys('ctrl+a')
    editor.type('ARRAY[1..2 * 3] OF INT')
    editor.keys('Return')
    assert '  Level : ARRAY[1..2 * 3] OF INT;\n' in editor.save(path)
    for key in 'Escape', 'Return':
        editor.into('Level, Type')
        editor.keys('ctrl+space')
        until(lambda: editor.all('Array…', 'push button'), 'the button')[0].press()
        last = until(lambda: editor.all('Last index', 'text'), 'the form of the array')[0]
        assert last.text() == '2 * 3', last.text()
        editor.shot('types-array-expression')
        editor.keys(key)
        until(lambda: not editor.all('Last index', 'text'), 'the end of the form')
        assert editor.find('Level, Type', 'text').text() == 'ARRAY[1..2 * 3] OF INT'
    editor.keys('ctrl+z')
    editor.into('Level, Initial value')
    window = editor.brought('ctrl+space', 'Initial values of Level')
    editor.focus_on('[1], Value', 'text')
    for value in '1', '7', '7', '7', '':
        editor.type(value)
        editor.keys('Down')
    editor.type('70000')
    editor.keys('Return')
    label(editor, 'out of range')
    editor.keys('ctrl+a')
    editor.type('-5')
    editor.keys('Return')
    label(editor, '[1, 3(7), 0, -5]')
    editor.shot('types-values')
    editor.keys('ctrl+a')
    editor.type('80000')
    x, y, width, height = editor.at_rest(editor.find('Set values', 'push button'))
    at = dict(line.split('=') for line in sh('xdotool', 'getwindowgeometry', '--shell', window).split())
    editor.click((int(at['X']) + x + width // 2, int(at['Y']) + y + height // 2))
    editor.shot('types-refused')
    label(editor, 'out of range')
    editor.keys('ctrl+Return')
    editor.focus_on('[6], Value', 'text')
    editor.keys('ctrl+Return')
    assert editor.focus_on('[6], Value', 'text').text() == '80000'
    fold = editor.find('Level', 'panel')
    for rows in 0, 6:
        x, y, _, height = fold.box()
        editor.click((int(at['X']) + x + 8, int(at['Y']) + y + height // 2))
        until(lambda: len([node for node in editor.all(', Value', 'text') if node.box()[2] > 0 and node.name[0] == '[']) == rows,
              '%d rows below the array' % rows)
    assert editor.find('[6], Value', 'text').text() == '80000'
    editor.click((int(at['X']) + x + 8, int(at['Y']) + y + height // 2))
    editor.keys('ctrl+Return')
    assert editor.focus_on('[6], Value', 'text').text() == '80000'
    editor.keys('Escape')
    until(lambda: editor.find('[6], Value', 'text').text() == '-5', 'the value before')
    editor.keys('ctrl+Return')
    editor.focus_on('Level, Initial value', 'text')
    text = editor.save(path)
    assert '  Level : ARRAY[1..6] OF INT := [1, 3(7), 0, -5];\n' in text, text
    editor.brought('ctrl+space', 'Initial values of Level')
    editor.focus_on('[1], Value', 'text')
    editor.keys('ctrl+a')
    editor.type('3')
    editor.keys('Return', 'Escape')
    editor.focus_on('Level, Initial value', 'text')
    editor.keys('ctrl+z')
    assert '  Level : ARRAY[1..6] OF INT;\n' in editor.save(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == PROGRAM


def keys_alone(screen):
    """choices and the form of an array by keys: Tab goes round in them, Escape goes back to the cell, a filter acts at once"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    sh('xdotool', 'windowsize', '--sync', editor.window, '800', '560')
    editor.keys('ctrl+alt+s')
    editor.into('Level, Type')

    def press(*steps):
        for key, name in steps:
            editor.keys(key)
            until(lambda: [node for node in editor.all(name) if node.has(12)], '%s: the focus on %s' % (key, name))
    press(('ctrl+space', 'Filter'), ('Tab', 'INT '), ('Down', 'DINT '), ('Tab', 'Array…'), ('Tab', 'Filter'), ('shift+Tab', 'Array…'),
          ('shift+Tab', 'INT '), ('Escape', 'Level, Type'))
    press(('ctrl+space', 'Filter'))
    editor.type('dint')
    press(('Tab', 'DINT '), ('Down', 'UDINT '), ('Return', 'Level, Type'))
    assert '  Level : UDINT;\n' in editor.save(path)
    press(('ctrl+z', 'Level, Type'), ('ctrl+space', 'Filter'), ('shift+Tab', 'Array…'), ('Return', 'First index'), ('Tab', 'Last index'),
          ('Tab', 'Type of the elements'), ('Tab', 'Set the type'), ('Tab', 'First index'), ('shift+Tab', 'Set the type'),
          ('space', 'Level, Type'))
    assert '  Level : ARRAY[0..9] OF INT;\n' in editor.save(path)
    press(('ctrl+space', 'Filter'))
    editor.type('real')
    press(('Return', 'Level, Type'))
    assert '  Level : REAL;\n' in editor.save(path)


LAMPS = '''RUNGBOARD 1

TYPE
  Color : (Red, Green := 5, Blue) := Green; (* of the lamp *)
  Line : STRUCT
    Front : Color;
    Level : INT;
  END_STRUCT;
  Level : INT (0..Limit) := 50; (* in percent *)
END_TYPE

VAR CONSTANT
  Limit : INT := 100;
END_VAR

VAR
  Lamp : Color := Blue;
  Tank : Level;
END_VAR

PROGRAM Main LD
RUNG
  | [ Lamp = Green ] | [ Lamp := Color#Red ] | COIL %QX0.0 |
END_PROGRAM
'''


def new_type(editor, kind, name):
    editor.command('New data type')
    until(lambda: editor.all(role='dialog'), 'the question for a name')
    editor.focus_on('Name', 'text')
    editor.keys('Tab')
    editor.focus_on('Kind')
    editor.keys('space')
    editor.choose(kind)
    editor.focus_on('Kind')
    editor.keys('shift+Tab')
    editor.focus_on('Name', 'text')
    editor.keys('ctrl+a')
    editor.type(name)
    editor.keys('Return')


def enumeration(screen):
    """an enumeration is made, its values named, numbered, moved, renamed everywhere and deleted; base type and initial value; each undoes"""
    path = new_file(screen, LAMPS)
    editor = Editor(screen, path)
    new_type(editor, 'Enumeration', 'Mode')
    editor.focus_on('Value1, Name', 'text')
    editor.keys('ctrl+a')
    editor.type('Idle')
    editor.keys('Tab')
    editor.focus_on('Idle, Number', 'text')
    editor.keys('ctrl+a')
    editor.type('3')
    editor.keys('Return')
    editor.into('Value2, Name')
    editor.keys('ctrl+a')
    editor.type('Fast')
    editor.keys('Return')
    editor.click(editor.find('Add a member or value', 'push button'))
    editor.focus_on('Value1, Name', 'text')
    editor.keys('ctrl+a')
    editor.type('fast')
    editor.keys('Return')
    label(editor, 'Value1, Name: ')
    editor.keys('ctrl+a')
    editor.type('Slow')
    editor.keys('Return')
    until(lambda: not editor.all('Value1, Name: ', 'label'), 'no refusal')
    ordered(editor, 'Idle', 'Fast', 'Slow')
    editor.keys('alt+Up')
    ordered(editor, 'Idle', 'Slow', 'Fast')
    assert seen(editor, 'Fast, Number').text() == '5'
    editor.into('Mode, Base type')
    editor.keys('ctrl+a')
    editor.type('US')
    until(lambda: seen(editor, 'Mode, Base type').text() == 'USINT', 'the rest of the word')
    editor.keys('Tab')
    editor.focus_on('Mode, Initial value', 'text')
    editor.keys('ctrl+space')
    until(lambda: editor.all('Slow ', 'list item'), 'the values')
    editor.shot('types-enumeration')
    editor.keys('Escape')
    editor.focus_on('Mode, Initial value', 'text')
    editor.type('Fast')
    editor.keys('Tab')
    editor.focus_on('Mode, Comment', 'text')
    editor.type('of the belt')
    editor.keys('Return')
    text = editor.save(path)
    assert '  Mode  : USINT (Idle := 3, Slow, Fast) := Fast; (* of the belt *)\n' in text, text
    assert '  Color : (Red, Green := 5, Blue) := Green; (* of the lamp *)\n' in text, text
    check(path)
    editor.into('Fast, Number')
    editor.keys('ctrl+a')
    editor.type('300')
    editor.keys('Return')
    label(editor, 'Fast, Number: ')
    editor.shot('types-number')
    editor.keys('Escape')
    until(lambda: not editor.all('Fast, Number: ', 'label'), 'no refusal')
    editor.click(editor.find('Data type', 'combo box'))
    editor.keys('Home', 'Return')
    editor.into('Green, Name')
    editor.keys('ctrl+a')
    editor.type('Olive')
    editor.keys('Return')
    text = editor.save(path)
    assert 'Color : (Red, Olive := 5, Blue) := Olive; (* of the lamp *)' in text and '[ Lamp = Olive ]' in text, text
    until(lambda: [node for node in editor.all('Olive, Name', 'text') if node.has(12)], 'the keys in the value')
    editor.keys('shift+F12')
    until(lambda: editor.all('Color#Olive', 'table row'), 'the uses of the value')
    assert len(editor.all('Color#Olive', 'table row')) == 3
    for name, left in ('Blue', 'Red, Olive := 5, Blue'), ('Red', 'Olive := 5, Blue'):  # an initial value cannot do without Blue
        editor.into(name + ', Name')
        editor.click(editor.find('Delete the member or value', 'push button'))
        label(editor, '“%s” is still used in 1 place' % name)
        text = editor.save(path) if name == 'Red' else open(path).read()
        assert '  Color : (%s) := Olive; (* of the lamp *)' % left in text, text
    editor.keys('ctrl+z', 'ctrl+z')
    until(lambda: editor.all('Green, Name', 'text') and editor.all('Red, Name', 'text'), 'the values before')
    assert 'Color : (Red, Green := 5, Blue) := Green; (* of the lamp *)' in editor.save(path)


def others(screen):
    """subranges, arrays and other names of types are made and edited; what cannot be read is refused at the cell; a problem is told in place"""
    path = new_file(screen, LAMPS)
    editor = Editor(screen, path)
    new_type(editor, 'Subrange', 'Percent')
    editor.focus_on('Percent, Lowest value', 'text')
    editor.keys('ctrl+a')
    editor.type('200')
    editor.keys('Return')
    label(editor, 'Percent, Lowest value: ')
    editor.keys('ctrl+a')
    editor.type('-10')
    editor.keys('Tab')
    editor.focus_on('Percent, Highest value', 'text')
    editor.keys('ctrl+a')
    editor.type('2 * Limit')
    editor.keys('Tab')
    editor.focus_on('Percent, Initial value', 'text')
    editor.type('500')
    editor.keys('Tab')
    editor.focus_on('Percent, Comment', 'text')
    editor.type('of all')
    editor.keys('Return')
    until(lambda: editor.all('Percent', 'table row'), 'the row')
    text = editor.save(path)
    assert '  Percent : INT (-10..2 * Limit) := 500; (* of all *)\n' in text, text
    editor.shot('types-subrange')
    editor.into('Percent, Initial value')
    editor.keys('ctrl+a')
    editor.type('50')
    editor.keys('Return')
    editor.save(path)
    check(path)
    new_type(editor, 'Array', 'Row')
    editor.focus_on('Row, Type', 'text')
    editor.keys('ctrl+space')
    until(lambda: editor.all('Array…', 'push button'), 'the button')[0].press()
    until(lambda: editor.all('Last index', 'text'), 'the form of the array')
    editor.keys('ctrl+a')
    editor.type('1')
    editor.keys('Return')
    editor.into('Row, Initial value')
    editor.type('[9(7)]')
    editor.keys('Return')
    text = editor.save(path)
    assert '  Row     : ARRAY[1..9] OF INT := [9(7)];\n' in text, text
    editor.shot('types-arrays')
    new_type(editor, 'Other name of a type', 'Hue')
    editor.focus_on('Hue, Type', 'text')
    editor.keys('ctrl+a')
    editor.type('Col')
    until(lambda: seen(editor, 'Hue, Type').text() == 'Color', 'the rest of the name')
    editor.keys('Tab')
    editor.type('Red')
    editor.keys('Return')
    text = editor.save(path)
    assert '  Hue     : Color := Red;\n' in text, text
    check(path)
    editor.into('Hue, Type')
    editor.keys('ctrl+a')
    editor.type('Hue')
    editor.keys('Return')
    label(editor, 'Hue, Type: ')
    editor.keys('Escape')
    editor.keys('ctrl+z', 'ctrl+z')
    assert 'Hue' in editor.save(path)
    editor.shot('types-alias')


def of_all_kinds(screen):
    """the tree lists types of all kinds in their order; by their menu there they are renamed, duplicated and deleted, a used one after a question"""
    path = new_file(screen, LAMPS)
    editor = Editor(screen, path)
    row = until(lambda: editor.all('Level', 'label'), 'the subrange in the tree')[0]
    label(editor, 'enumeration')
    label(editor, 'INT (0..Limit)')
    editor.shot('types-tree')
    editor.click(editor.find('Color', 'label'), count=2)
    editor.focus_on('Red, Name', 'text')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Paint')
    editor.keys('Return')
    label(editor, '4 places changed')
    text = editor.save(path)
    assert '  Paint : (Red, ' in text and 'Front : Paint;' in text and 'Lamp : Paint := Blue;' in text and 'Paint#Red' in text, text
    check(path)
    editor.click(editor.find('Duplicate the type', 'push button'))
    until(lambda: editor.all(role='dialog'), 'the question for a name')
    editor.keys('Return')
    until(lambda: editor.all('Paint2', 'label'), 'the copy')
    assert '  Paint2 : (Red, Green := 5, Blue) := Green; (* of the lamp *)\n' in editor.save(path)
    editor.click(editor.find('Delete the type', 'push button'))
    until(lambda: not editor.all('Paint2', 'label'), 'the end of the copy')
    assert 'Paint2' not in editor.save(path)
    editor.click(editor.find('Level', 'label'), count=2)
    editor.focus_on('Level, Lowest value', 'text')
    editor.click(editor.find('Delete the type', 'push button'))
    label(editor, 'It is used in 1 place. Variables and members of this type are deleted, too.')
    editor.answer('Delete anyway')
    text = until(lambda: 'Tank' not in editor.save(path) and open(path).read(), 'the end of the type')
    assert 'INT (0..Limit)' not in text and 'Lamp' in text, text
    editor.keys('ctrl+z')
    until(lambda: editor.all('INT (0..Limit)', 'label'), 'the type in the tree')
    assert 'Tank : Level;' in editor.save(path)


MODES = '''RUNGBOARD 1

TYPE
  Mode : (Idle, Slow, Fast);
  Pace : Mode := Slow;
END_TYPE

VAR
  Now : Mode;
  Key : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | [ Now = Idle ] | [ Now := Mode#Fast ] | COIL %QX0.0 |
END_PROGRAM

PROGRAM List IL
  LD    Fast
  ST    Now
END_PROGRAM

PROGRAM Text ST
VAR
  Last : Pace;
END_VAR
  IF Now = Slow THEN
    Last := Mode#Fast;
  END_IF;
END_PROGRAM

PROGRAM Way SFC
  INITIAL_STEP Start:
  END_STEP
  STEP Run:
  END_STEP
  TRANSITION FROM Start TO Run := Key AND Now = Fast; END_TRANSITION
  TRANSITION FROM Run TO Start := NOT Key; END_TRANSITION
END_PROGRAM
'''


def to_text(editor, name):
    """Brings the text of that program to the front, with the keys in it."""
    editor.click(editor.find(name, 'label'), count=2)
    return until(lambda: [node for node in editor.all('Text of the program') if 'PROGRAM ' + name in node.text() and node.has(12)], name)[0]


def go(editor, view, before, word):
    """Moves the cursor into a word of the text."""
    text = view.text()
    at = text.index(before) + before.index(word) + 1
    line = text[:at].count('\n')
    column = at - text.rfind('\n', 0, at) - 1
    editor.keys('ctrl+Home', *['Down'] * line, *['Right'] * column)
    editor.says('Line %d \u00b7 column %d' % (line + 1, column + 1))


def modes(screen):
    """uses, definition and renaming of values and types in a ladder, a list, Structured Text and a chart"""
    path = new_file(screen, MODES)
    editor = Editor(screen, path)

    def uses(name):
        def look():
            rows = [node.name for node in editor.all(role='table row') if ' ' in node.name and node.box()[2] > 0 and ', ' in node.name]
            return len([row for row in rows if row.startswith(name + ' ')]) > 1
        until(look, 'the uses of ' + name)
    editor.to_sheet()
    editor.keys('Right', 'shift+F12')  # Now, then the two others of the cell
    uses('Now')
    editor.keys('shift+F12')
    uses('Mode')
    editor.keys('shift+F12')
    uses('Mode#Fast')
    editor.shot('uses-value')
    for program, before, word, kind in ('List', 'LD    Fast', 'Fast', 'Mode#Fast'), ('Text', 'Now = Slow', 'Slow', 'Mode#Slow'), \
            ('Text', 'Last := Mode#Fast', 'Fast', 'Mode#Fast'):
        view = to_text(editor, program)
        go(editor, view, before, word)
        editor.keys('shift+F12')
        uses(kind)
        editor.click(view)
        go(editor, view, before, word)
        editor.keys('alt+F12')
        editor.focus_on(word + ', Name', 'text')
    editor.shot('uses-definition')
    view = to_text(editor, 'Text')
    go(editor, view, 'Last : Pace', 'Pace')
    editor.keys('F12')
    editor.focus_on('Pace, Type', 'text')
    view = to_text(editor, 'Text')
    go(editor, view, 'Mode#Fast', 'Fast')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Quick')
    editor.keys('Return')
    text = until(lambda: 'Mode#Quick;' in view.text() and editor.save(path), 'the new name')
    assert 'Fast' not in text and text.count('Quick') == MODES.count('Fast'), text
    check(path)
    editor.keys('ctrl+z')
    text = editor.save(path)
    assert 'Quick' not in text and text.count('Fast') == MODES.count('Fast'), text


MEMORY = '''RUNGBOARD 1

VAR
  Speed AT %MW4   : WORD;
  Over  AT %MX4.1 : BOOL;
  Idle  AT %QX0.7 : BOOL;
  I               : INT;
END_VAR

PROGRAM Main LD
RUNG
  | NO Over | [ Speed > %MW20 ] | COIL %QX0.0 |
RUNG
  | NO %IX0.0 | COIL %QX0.0 |
RUNG
  | [ %MW40[I] > 3 ] | COIL %QX1.0 |
END_PROGRAM
'''


def wide(screen):
    """the members of a structure take the whole width of the page: a hidden column takes none of it"""
    editor = Editor(screen, os.path.join(ROOT, 'ladders', 'cement-plant', 'cement-plant.rung'))
    editor.command('Data types')
    row = until(lambda: [node for node in editor.all('Total, REAL', 'table row') if node.box()[2] > 0], 'the row of Total')[0]
    left, _, width, _ = editor.place()

    def free():
        x, _, wide, _ = editor.place(row)
        return left + width - x - wide
    editor.shot('types-wide')
    until(lambda: free() <= 24, 'the row to end at the edge: %d px are free' % free())


wide.size = '1024x700x24'


def addresses(screen):
    """the map names each bit; arrows and Enter go to a symbol or to the uses; an edit is shown at once; shared memory alone"""
    path = new_file(screen, MEMORY)
    editor = Editor(screen, path)
    editor.command('Address map')
    editor.focus_on('%IX0.7: free', 'push button')
    editor.keys('Down', 'Down')
    editor.focus_on('%QX0.7: Idle, 0 uses, Declared, never used', 'push button')
    editor.keys('End', 'Left', 'Left', 'Left', 'Left')
    editor.focus_on('%QX0.0: 2 uses, written in 2 places, Written twice', 'push button')
    editor.shot('address-map')
    editor.keys('Return')
    editor.find('%QX0.0 %QX0.0 coil, Main, rung 2', 'table row')
    editor.click(editor.find('%MX4.1: Over', 'push button'))
    editor.find('Speed %MW4 read, Main, rung 1', 'table row')
    kinds = editor.find('Rows that are shown', 'combo box')
    editor.click(kinds)
    editor.keys('Down', 'Return')
    until(lambda: not editor.all('%MW20: 1 use'), 'only shared memory')
    editor.click(editor.find('%MW4: Speed', 'push button'))
    editor.focus_on('Speed, Name', 'text')
    editor.type('Rate')
    editor.keys('Return')
    editor.command('Address map')
    until(lambda: editor.all('%MW4: Rate'), 'the new name in the map')
    kinds = until(lambda: [node for node in editor.all('Rows that are shown', 'combo box') if node.box()[2] > 0], 'the kinds')[0]
    editor.click(kinds)
    editor.keys('Down', 'Down', 'Down', 'Return')
    until(lambda: not editor.all('%MW4: Rate'), 'only what an index may reach')
    editor.find('bytes that an index may reach', 'label')
    editor.find('%MW40: 1 use', 'push button')
    editor.shot('address-reached')
    assert 'Rate AT %MW4' in editor.save(path)
    check(path)


main([structure, completed, everywhere, array, keys_alone, enumeration, others, of_all_kinds, modes, wide, addresses])
