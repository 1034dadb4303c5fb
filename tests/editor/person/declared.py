#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""declared - a new name at the cursor: its address and type are typed with it, or chosen from the list."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR_GLOBAL
  Start_of_belt AT %IX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start_of_belt |
END_PROGRAM
'''


def bottom(node):
    _, y, _, height = node.box()
    return y + height


def typed(screen):
    """an address and a type behind a name are declared with the element, in one step"""
    path = new_file(screen)
    editor = Editor(screen, path)
    before = open(path).read()
    editor.to_sheet()
    editor.entry('Open %IX0.5')
    editor.entry('XIO Gate : BOOL')
    editor.entry('OUT Lamp AT %QX0.7 : BOOL')
    text = editor.save(path)
    for wanted in 'Open AT %IX0.5 : BOOL;', 'Gate : BOOL;', 'Lamp AT %QX0.7 : BOOL;':
        assert '  %s\n' % wanted in text, text
    assert '| NO Open | NC Gate | COIL Lamp |' in text, text
    check(path)
    assert lines(path, '@print %QX0.7\n%IX0.5=1\nGate=1\n') == ['%QX0.7=1', '%QX0.7=0']
    editor.keys('ctrl+z')
    text = editor.save(path)
    assert 'Lamp' not in text and 'Gate : BOOL;' in text, text
    editor.keys('ctrl+z', 'ctrl+z')
    assert editor.save(path) == before


def refused(screen):
    """an impossible declaration is refused at once, with the place of the conflicting one; the entry stays open"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('End')
    editor.type('OUT Start_of_belt %QX0.1')
    told = editor.says('the name is declared already as Start_of_belt AT %IX0.0 : BOOL, line 4')
    until(lambda: bottom(told) <= bottom(editor.known()[told.parent]), 'all of it to be seen')
    editor.shot('declared-otherwise')
    editor.keys('Return')
    editor.says('the name is declared already as Start_of_belt')
    assert editor.asked()[0].text() == 'OUT Start_of_belt %QX0.1'
    editor.keys('ctrl+a')
    editor.type('OUT Lamp %QX0.9')
    editor.says('“%QX0.9” is not an address: the bits of a byte are 0 to 7')
    editor.keys('ctrl+a')
    editor.type('OUT Lamp : LAMP')
    editor.says('“LAMP” is not a type')
    editor.keys('Escape')
    editor.gone()
    editor.keys('Home')
    editor.type('Begin %IX0.0')
    editor.says('new: Begin AT %IX0.0 : BOOL (Start_of_belt has the same address)')
    editor.shot('declared-shared')
    editor.keys('Return')
    editor.gone()
    assert editor.save(path).count(' AT %IX0.0 : BOOL;') == 2
    editor.keys('End')
    editor.entry('OUT Lamp %QX0.1')
    editor.save(path)
    check(path)
    assert lines(path, '@print %QX0.1\nBegin=1\nStart_of_belt=0\n') == ['%QX0.1=1', '%QX0.1=0']


def chosen(screen):
    """the list offers a new name with each possible address: by pointer, by keys, to be edited"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('Open')
    editor.candidate('Open, new %IX0.0 BOOL')
    editor.candidate('Open, new  BOOL, no address')
    marker = editor.candidate('Open, new %MX0.0 BOOL')
    editor.shot('declared-list')
    editor.click(editor.popped(marker))
    editor.gone()
    editor.type('Gate')
    editor.opened()
    editor.keys('Down', 'Down', 'Down', 'Return')
    editor.gone()
    editor.type('OUT Lamp')
    editor.candidate('Lamp, new %MX0.1 BOOL')  # there are markers and no outputs yet
    editor.candidate('Lamp, new %QX0.0 BOOL')
    editor.keys('Down', 'Down', 'Tab')
    until(lambda: editor.asked()[0].text() == 'OUT Lamp AT %QX0.0', 'the address in the line')
    editor.keys('BackSpace')
    editor.type('6')
    editor.keys('Return')
    editor.gone()
    text = editor.save(path)
    for wanted in 'Open AT %MX0.0 : BOOL;', 'Gate : BOOL;', 'Lamp AT %QX0.6 : BOOL;':
        assert '  %s\n' % wanted in text, text
    assert '| NO Open | NO Gate | COIL Lamp |' in text, text
    check(path)
    assert lines(path, '@print %QX0.6\n%MX0.0=1\nGate=1\nOpen=0\n') == ['%QX0.6=0', '%QX0.6=1', '%QX0.6=0']


def anywhere(screen):
    """also at a pin and in a comparison: the type that fits, with addresses of its width"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.entry('Level AT %IW2 : INT > 80')
    editor.type('Heat > Most')
    editor.says('new: Heat : INT; new: Most : INT')
    editor.candidate('Most, new %MW0 INT')
    editor.candidate('Most, new  INT, no address')
    editor.keys('Down', 'Down', 'Tab')
    until(lambda: editor.asked()[0].text() == 'Heat > Most AT %IW0', 'the address in the line')
    editor.shot('declared-compared')
    editor.keys('Return')
    editor.gone()
    editor.type('TON D1 Wait AT %MD4')
    editor.says('the address is not as wide as its type: %MD4, TIME: %ML')
    for _ in range(3):
        editor.keys('BackSpace')
    editor.candidate('Wait, new %ML0 TIME')
    editor.shot('declared-pin')
    editor.type('ML8 : TIME')
    editor.keys('Return')
    editor.gone()
    editor.entry('OUT Lamp %QX0.1')
    text = editor.save(path)
    text = re.sub(' +', ' ', text)
    for wanted in ('Level AT %IW2 : INT;', 'Most AT %IW0 : INT;', 'Heat : INT;', 'Wait AT %ML8 : TIME;', 'D1 : TON;'):
        assert ' %s\n' % wanted in text, (wanted, text)
    assert '[ Level > 80 ] | [ Heat > Most ] | TON D1 PT:=Wait | COIL Lamp |' in text, text
    check(path)
    assert lines(path, '@print %QX0.1\n%IW2=81 Heat=1\n%IW2=80\n') == ['%QX0.1=1', '%QX0.1=0']
    for _ in range(4):
        editor.keys('ctrl+z')
    assert 'Level' not in editor.save(path)


def given_back(screen):
    """Esc restores the rung as the cursor found it, without the names declared for it; Ctrl+Z undoes that"""
    path = new_file(screen)
    editor = Editor(screen, path)
    before = open(path).read()
    editor.to_sheet()
    editor.entry('Open')  # the first declaration of the file: the file is read again
    editor.entry('TON D1 Wait')
    editor.entry('OUT Lamp')
    edited = editor.save(path)
    check(path)
    editor.keys('Escape')
    until(lambda: not editor.all('Lamp'), 'the empty rung')
    editor.shot('declared-given-back')
    assert editor.save(path) == before
    editor.keys('Escape')  # unchanged
    editor.keys('ctrl+z')
    editor.element('Lamp')
    assert editor.save(path) == edited
    # Changes elsewhere since then stay.
    editor.keys('Home')
    editor.brought('F2')
    editor.keys('ctrl+a')
    editor.type('Opened')
    editor.keys('Return')
    editor.element('Opened')
    editor.to_sheet()
    edited = editor.save(path)
    editor.keys('Escape')
    editor.says('Other things were changed since')
    editor.shot('declared-not-given-back')
    editor.keys('Insert')  # the rung below: the cursor left the rung
    editor.entry('OUT More')
    editor.keys('Escape')
    until(lambda: not editor.all('More'), 'the empty rung below')
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    until(lambda: len(editor.elements()) == 3, 'one rung')


def marked(editor, line):
    """The parts of an open line that are underlined as wrong."""
    text, at, parts = line.text(), 0, []
    while at < len(text):
        run, start, end = editor.ask([(line.path, 'Text', 'GetAttributeRun', 'ib', at, False)])[0]
        if run.get('underline') == 'error':
            parts.append(text[start:end])
        at = max(end, at + 1)
    return parts


def underlined(screen):
    """the wrong part of an address, or a refused name, is underlined while it is typed, and the message says what is allowed"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()

    def says(line, part, text):
        editor.type(line)
        editor.says(text)
        until(lambda: marked(editor, editor.asked()[0]) == part, '%s in %s to be underlined' % (part, line))

    for line, part, text in (
            ('NO %IX0.9', ['9'], 'the bits of a byte are 0 to 7'), ('%QX0.8', ['8'], 'the bits of a byte are 0 to 7'),
            ('%IX99999.0', ['99999'], 'its area ends at byte 511'), ('%KX0.0', ['KX'], 'the areas are I, Q, M'),
            ('2fast', ['2fast'], '“2fast” cannot be the name of a variable'),
            ('Start_of_belt %IX0.3', ['Start_of_belt'], 'the name is declared already as'),
            ('%MW0 > %MW4 + %QW2.16', ['16'], 'its bits are 0 to 15')):
        says(line, part, text)
        editor.shot('declared-underlined-' + part[0])
        editor.keys('ctrl+a', 'BackSpace')
        until(lambda: not marked(editor, editor.asked()[0]), 'nothing to be underlined')
    says('OUT Lamp %QX0.9', ['9'], 'the bits of a byte are 0 to 7')
    editor.keys('BackSpace', '5')
    until(lambda: editor.asked()[0].text() == 'OUT Lamp %QX0.5' and not marked(editor, editor.asked()[0]), 'a good line')
    editor.keys('Return')
    editor.gone()


main([typed, underlined, refused, chosen, anywhere, given_back])
