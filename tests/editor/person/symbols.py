#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""symbols - a person finds and replaces, renames everywhere, and works in the symbol table."""
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
  Horn  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Lamp"
  | NO Start | COIL Lamp |
RUNG
  | NO Lamp | COIL Horn |
END_PROGRAM
'''


BLOCK = '''FUNCTION_BLOCK Valve LD
VAR_INPUT
  Open  : BOOL;
  Speed : INT := 3; (* of the shaft *)
END_VAR
VAR_OUTPUT
  Ready : BOOL;
END_VAR
RUNG
  | NO Open | COIL Ready |
END_FUNCTION_BLOCK

'''


def label(editor, text):
    until(lambda: editor.all(text, 'label'), 'the text "%s"' % text)


def finds(screen):
    """find, go to the next hit, replace all, undo"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+h')
    editor.find('Find', 'text')
    editor.type('Lamp')
    label(editor, '4 hits')
    editor.keys('Return')
    label(editor, 'of 4')
    editor.into('Replace with')
    editor.type('Bell')
    editor.shot('names-find')
    editor.keys('alt+a')
    label(editor, '4 replaced')
    editor.keys('Escape')
    text = editor.save(path)
    assert 'Lamp' not in text and text.count('Bell') == 4, text
    check(path)
    assert lines(path, '@print Horn\nStart=1\nStart=0\n') == ['Horn=1', 'Horn=0']
    editor.keys('ctrl+z')
    assert editor.save(path) == PROGRAM


def declared_already(screen):
    """replace all by the name of another symbol is refused with a message"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+h')
    editor.type('Lamp')
    label(editor, '4 hits')
    editor.into('Replace with')
    editor.type('Horn')
    editor.keys('alt+a')
    label(editor, 'is declared already')
    time.sleep(0.5)  # longer than the delay of a panel
    label(editor, 'is declared already')
    editor.shot('names-declared-already')
    assert open(path).read() == PROGRAM and not editor.all('\u2022 new.rung', 'label')


def renames(screen):
    """F2: a Chinese name, wherever the symbol is used; one step to undo"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.click(editor.grid(60, 0))
    editor.keys('Right', 'End')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('\u7535\u673a')
    editor.shot('names-rename')
    editor.keys('Return')
    label(editor, '3 places changed')
    text = editor.save(path)
    assert text.count('\u7535\u673a') == 3 and '"Lamp"' in text, text
    check(path)
    assert lines(path, '@print \u7535\u673a\nStart=1\nStart=0\n') == ['\u7535\u673a=1', '\u7535\u673a=0']
    assert lines(path, '@print Horn\nStart=1\nStart=0\n') == ['Horn=1', 'Horn=0']
    editor.keys('ctrl+z')
    assert editor.save(path) == PROGRAM


def uses(screen):
    """the cross reference keeps the chosen name as long as it exists, then follows the cursor"""
    path = new_file(screen, PROGRAM.replace('NO Start', 'NO %MX1.0', 1))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'shift+F12')
    row = '%MX1.0 %MX1.0 read, Main, rung 1, row 1, column A'
    editor.find(row, 'table row')
    editor.keys('End')
    assert editor.all(row, 'table row')
    editor.keys('Home', 'Delete')
    editor.says('Place the cursor on an element to see where its name is used.')
    editor.keys('End')
    editor.find('Lamp %QX0.0 coil, Main, rung 1', 'table row')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Signal')
    editor.keys('Return')
    editor.find('Signal %QX0.0 coil, Main, rung 1', 'table row')
    editor.to_sheet()
    editor.keys('ctrl+z')
    editor.find('Lamp %QX0.0 coil, Main, rung 1', 'table row')


def tables(screen):
    """the symbol table: a comment, a refused name, an accepted one"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    editor.into('Horn, Comment')
    editor.type('loud')
    editor.keys('Return')
    assert '(* loud *)' in editor.save(path)
    editor.into('Horn, Comment')
    editor.keys('ctrl+a')
    editor.type('a *) b')
    editor.keys('Return')
    label(editor, 'Horn, Comment: a comment is one line without (* and *)')
    editor.keys('Escape')
    editor.into('Horn, Address')
    editor.keys('ctrl+a')
    editor.type('%QX0.0')
    editor.keys('Return')
    label(editor, 'Horn, Address: Lamp has the same address')
    editor.shot('names-beside')
    editor.keys('ctrl+a')
    editor.type('%QX0.1')
    editor.keys('Return')
    until(lambda: not editor.all('has the same address', 'label'), 'nobody to lie there')
    editor.into('Horn, Name')
    editor.keys('ctrl+a')
    editor.type('Lamp')
    editor.keys('Return')
    label(editor, 'is declared already')
    editor.into('Start, Name')
    editor.keys('ctrl+a', 'BackSpace', 'Return')
    label(editor, 'Start, Name: ')
    editor.shot('names-table')
    editor.keys('Escape')
    editor.into('Horn, Name')
    editor.keys('Escape')
    until(lambda: not editor.all('is declared already', 'label'), 'nothing to be refused')
    editor.keys('ctrl+a')
    editor.type('Lamp')
    editor.keys('Return')
    label(editor, 'is declared already')
    editor.keys('ctrl+a')
    editor.type('Siren')
    editor.keys('Return')
    text = editor.save(path)
    assert 'Siren AT %QX0.1 : BOOL; (* loud *)' in text and 'COIL Siren' in text, text
    check(path)
    assert lines(path, '@print Siren\nStart=1\nStart=0\n') == ['Siren=1', 'Siren=0']
    assert lines(path, '@print %QX0.1\nStart=1\n') == ['%QX0.1=1']


def added(screen):
    """+: the name of the new symbol has the keys, its text selected, wherever its row is sorted"""
    many = ''.join('  V%02d : INT;\n' % number for number in range(60))
    path = new_file(screen, PROGRAM.replace('END_VAR', many + 'END_VAR', 1))
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    for name in 'Pump', 'Valve':
        before = editor.focused()  # the cell of another symbol may have the focus
        editor.click(editor.find('Add a symbol', 'push button'))
        cell = editor.focus_on(', Name', 'text', but=before)
        editor.type(name)  # the old text was selected
        until(lambda: cell.text() == name, 'the name that is typed')
        time.sleep(0.3)  # the table is read again meanwhile
        editor.type('1')
        editor.keys('Return')
        editor.focus_on(name + '1, Name', 'text')
        assert editor.place(cell)[1] < editor.place(editor.find('Problems', 'page tab'))[1], 'it is out of sight'
        editor.shot('symbols-added-' + name)
    text = editor.save(path)
    assert 'Pump1' in text and 'Valve1' in text, text
    check(path)


def ticked(screen):
    """Space and a click on Retain move the declaration to another block; the keys stay with it"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')

    def box(name):
        return until(lambda: [node for node in editor.all(name, 'check box') if node.box()[2] > 0], name)[0]
    editor.into('Start, Initial value')
    editor.keys('Tab')
    editor.focus_on('Start, Retain', 'check box')
    top = box('Start, Retain').box()[1]
    editor.keys('space')
    until(lambda: box('Start, Retain').box()[1] > top, 'the row at its new place')
    editor.focus_on('Start, Retain', 'check box')
    editor.shot('symbols-ticked')
    assert 'VAR RETAIN\n  Start' in editor.save(path)
    editor.keys('space', 'Tab')
    time.sleep(0.5)  # the table is read again meanwhile
    editor.focus_on('Start, Constant', 'check box')
    assert 'RETAIN' not in editor.save(path)
    for wanted in True, False:
        editor.click(box('Lamp, Constant'))
        time.sleep(0.5)
        editor.focus_on('Lamp, Constant', 'check box')
        assert ('CONSTANT' in editor.save(path)) is wanted
    check(path)


def imported(screen):
    """a table is imported by a command: the preview shows changes and the line that breaks the program; then it has the error"""
    path = new_file(screen, PROGRAM)
    table = new_file(screen, 'Name,Type,Address\nLamp,INT,\nBell,BOOL,%QX0.7\n', 'symbols.csv')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.give_path(table, lambda: editor.command('Import symbols'), 'Import symbols')
    editor.find('1 new, 1 changed, 0 unchanged, 0 refused; after 1 of these lines the program has a fault', 'label')
    editor.find('"Lamp" must be BOOL', 'table row')
    editor.shot('symbols-import')
    assert [node for node in editor.all(', Name') if node.box()[2] > 0], 'the page of the symbols is not in front'
    editor.keys('Return')
    editor.find('Bell, Name', 'text')
    editor.find('must be BOOL')
    text = editor.save(path)
    assert '  Lamp  : INT;' in text and '  Bell  AT %QX0.7 : BOOL;' in text, text


def block(screen):
    """a new block has an input and an output; + adds another; a call uses it"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.command('new function block')
    editor.element('Rung 1, COIL', 'Out')
    check_text = editor.save(path)
    check(path)
    assert 'VAR_INPUT\n  In : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Out : BOOL;\nEND_VAR\n' in check_text, check_text
    editor.keys('ctrl+alt+s')
    editor.find('Block1 VAR_OUTPUT', 'label')
    editor.into('Out, Name')
    editor.click(editor.find('Add a symbol', 'push button'))
    editor.focus_on('Out2, Name', 'text')
    editor.type('Ready')
    editor.keys('Return')
    editor.shot('symbols-block')
    text = editor.save(path)
    assert 'VAR_OUTPUT\n  Out   : BOOL;\n  Ready : BOOL;\nEND_VAR\n' in text, text
    editor.find('Where it is used', 'push button').press()
    editor.find('Block1', 'label')
    check(path)


def ordered(screen):
    """a click on a column's title sorts by it, again in reverse; numbers by value, texts without case"""
    names = 'Step10', 'b', 'Txt', 'Step2', 'n'
    text = 'RUNGBOARD 1\n\nVAR\n' + ''.join('  %s : INT;\n' % name for name in names) + \
        'END_VAR\n\nPROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n'
    path = new_file(screen, text)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')

    def rows():
        return [name for _, name in sorted((editor.place(editor.find(name + ', Name', 'text'))[1], name)
                                           for name in names)]
    until(lambda: rows() == list(names), 'the order of the file')
    title = editor.find('Name', 'label')
    editor.click(title)
    until(lambda: rows() == ['b', 'n', 'Step2', 'Step10', 'Txt'], 'the order of names')
    editor.shot('symbols-ordered')
    editor.click(title)
    until(lambda: rows() == ['Txt', 'Step10', 'Step2', 'n', 'b'], 'the other way')
    assert open(path).read() == text
    assert not editor.all('\u2022')


def scopes(screen):
    """the table of one program, of the globals, of all: by keys and by mouse; for new names, too"""
    path = new_file(screen, PROGRAM.replace('PROGRAM Main LD\n', 'PROGRAM Main LD\nVAR\n  Own : INT;\nEND_VAR\n'))
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')

    def shows(*names):
        until(lambda: sorted(name for name in ('Start', 'Lamp', 'Horn', 'Own')
                             if editor.all(name + ', Name')) == sorted(names), 'the rows ' + ' '.join(names))
    shows('Start', 'Lamp', 'Horn', 'Own')
    scope = editor.find('Scope', 'combo box')
    editor.click(scope)
    editor.keys('Down', 'Down', 'Return')
    shows('Own')
    editor.keys('space', 'Up', 'Return')
    shows('Start', 'Lamp', 'Horn')
    editor.shot('names-scopes')
    editor.into('Horn, Name')
    editor.keys('ctrl+a')
    editor.type('Siren')
    editor.keys('Return')
    until(lambda: editor.all('Siren, Name'), 'the new name among the global ones')
    assert not editor.all('Own, Name')
    editor.keys('ctrl+a')
    editor.type('Bell')
    # The check of the typed text arrives while the button is down.
    x, y = editor.centre(editor.find('Scope', 'combo box'))
    sh('xdotool', 'key', 'Return', 'mousemove', str(x), str(y), 'mousedown', '1', 'sleep', '0.8', 'mouseup', '1')
    until(lambda: editor.all('Bell, Name'), 'the name again')
    editor.focus_on(role='list item')
    editor.click(editor.find('All symbols', 'label'))
    until(lambda: editor.all('Own, Name') and editor.all('Bell, Name'), 'all of them')
    assert 'Bell  AT %QX0.1' in editor.save(path)


def kinds(screen):
    """an input becomes an output and an in-out; globals have no such kinds"""
    path = new_file(screen, PROGRAM.replace('PROGRAM Main LD\n', BLOCK + 'PROGRAM Main LD\n'))
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')

    def offered():
        return [node for node in editor.all('Kind of declaration', 'combo box') if node.box()[2] > 0]
    editor.into('Speed, Name')
    until(offered, 'a choice')
    editor.into('Horn, Name')
    until(lambda: not offered(), 'no choice for a global symbol')
    editor.into('Speed, Name')

    def choose(text):
        editor.click(until(offered, 'a choice')[0])
        editor.focus_on(role='list item')
        editor.keys('Home')
        editor.choose(text)
        until(lambda: not editor.all('VAR_TEMP', 'label'), 'the list to be gone: it would take the keys')
    choose('VAR_OUTPUT')
    text = editor.save(path)
    assert '  Ready : BOOL;\n  Speed : INT := 3; (* of the shaft *)\nEND_VAR' in text, text
    editor.shot('symbols-kinds')
    editor.click(editor.find('Speed, Retain', 'check box'))
    text = editor.save(path)
    choose('VAR_TEMP')
    editor.find('Speed: "RETAIN" does not belong here', 'label')
    editor.shot('symbols-kinds-refused')
    editor.into('Open, Name')
    choose('VAR_IN_OUT')
    text = editor.save(path)
    assert 'VAR_IN_OUT\n  Open : BOOL;\nEND_VAR' in text and 'VAR_INPUT' not in text and 'TEMP' not in text, text
    editor.keys('ctrl+z')
    text = editor.save(path)
    assert 'VAR_INPUT\n  Open' in text, text
    check(path)


def through(screen):
    """Tab fills the cells of a row one after the other while the table is read again behind each"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    for name, delay in ('Start', 15), ('Lamp', 40), ('Horn', 80):
        editor.into(name + ', Initial value')
        editor.keys('ctrl+a')
        sh('xdotool', 'type', '--delay', str(delay), 'TRUE\t\t\tcomment of it')
        editor.keys('Return')
    text = editor.save(path)
    for name, address in ('Start', 'IX0.0'), ('Lamp ', 'QX0.0'), ('Horn ', 'QX0.1'):
        assert '%s AT %%%s : BOOL := TRUE; (* comment of it *)' % (name, address) in text, text
    check(path)
    editor.keys(*['ctrl+z'] * 6)
    assert editor.save(path) == PROGRAM


def last_letter(screen):
    """save and close right behind the last letter in a cell: it is in the file; a refused text keeps the window once"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    editor.into('Horn, Comment')
    editor.type('loud')
    assert 'Horn  AT %QX0.1 : BOOL; (* loud *)' in editor.save(path)
    editor.into('Horn, Comment')
    editor.keys('End')
    editor.type('er')
    editor.keys('ctrl+w')
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the window to close')
    assert '(* louder *)' in open(path).read()
    check(path)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    editor.into('Horn, Address')
    editor.keys('ctrl+a')
    editor.type('%QX')
    editor.keys('ctrl+w')
    label(editor, 'Horn, Address: ')
    editor.shot('symbols-refused-closing')
    editor.keys('ctrl+w')
    until(lambda: editor.process.poll() is not None, 'the window to close')
    assert lines(path, '@print Horn\nStart=1\n') == ['Horn=1']


def again(screen):
    """a list closed by Esc opens at the next click, also when the pointer has not moved"""
    path = new_file(screen, PROGRAM.replace('PROGRAM Main LD\n', 'PROGRAM Main LD\nVAR\n  Own : INT;\nEND_VAR\n'))
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    until(lambda: editor.all('Own, Name'), 'the table')

    def seen():
        """All windows on the screen, also that of a drop-down: to see it close."""
        return sh('xdotool', 'search', '--onlyvisible', '--class', 'ladder-editor').split()
    alone = seen()
    editor.click(editor.find('Scope', 'combo box'))
    for _ in range(4):
        editor.focus_on(role='list item')
        until(lambda: seen() != alone, 'the list on the screen')
        editor.keys('Escape')
        until(lambda: seen() == alone, 'the end of the list')
        sh('xdotool', 'click', '1')
    editor.focus_on(role='list item')



def access(screen):
    """a symbol is given to operators: by the list above the table, in the file and in the column"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')

    def choose(text):
        editor.click(until(lambda: [node for node in editor.all('Access for operators', 'combo box')
                                    if node.box()[2] > 0], 'a choice')[0])
        editor.focus_on(role='list item')
        editor.keys('Home')
        editor.choose(text)
        until(lambda: not editor.all('No access for operators', 'list item'), 'the list to be gone')
    editor.into('Lamp, Name')
    choose('READ_WRITE')
    text = editor.save(path)
    assert 'VAR_ACCESS\n  Lamp : Lamp : BOOL READ_WRITE;\nEND_VAR' in text, text
    editor.into('Start, Name')
    choose('READ_WRITE')
    text = editor.save(path)
    assert 'Start : Start : BOOL READ_WRITE' in text, text
    until(lambda: editor.find('Start, Access', 'text').text() == 'READ_WRITE', 'the access in its column')
    editor.shot('symbols-access')
    choose('READ_ONLY')
    text = editor.save(path)
    assert 'Start : Start : BOOL READ_ONLY' in text, text
    editor.keys('ctrl+z')
    assert 'Start : Start : BOOL READ_WRITE' in editor.save(path)
    editor.into('Lamp, Name')
    choose('No access for operators')
    assert '  Lamp : Lamp' not in editor.save(path)
    editor.into('Start, Access')
    editor.keys('ctrl+a')
    editor.type('READ_ONLY: Begin')
    editor.keys('Return')
    assert '  Begin : Start : BOOL READ_ONLY;' in editor.save(path)
    editor.keys('ctrl+a')
    editor.type('two words')
    editor.keys('Return')
    editor.find('Start, Access: ', 'label')
    editor.keys('Escape', 'ctrl+space')
    editor.focus_on(role='list item')
    editor.shot('symbols-access-name')
    editor.choose('READ_WRITE: Begin')
    assert '  Begin : Start : BOOL READ_WRITE;' in editor.save(path)


main([access, finds, declared_already, renames, uses, tables, added, ticked, imported, ordered, scopes, kinds, through, last_letter, again])
