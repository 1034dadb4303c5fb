#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""tutorial - docs/tutorial.md is true: this script reads its keys and presses them.

A step is a line such as "2. `Up` `End` `Delete`: the coil is gone": keys and texts up to the first colon. The
expected result of each step is in this script.
"""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROLES, ROOT, Editor, check, lines, main, new_file, until  # noqa: E402

with open(os.path.join(ROOT, 'docs', 'tutorial.md')) as page:
    TUTORIAL = page.read()
PICTURES = ('1-contact', '2-negated', '3-coil', '4-seal-in')
KEY = re.compile(r'((?:(?:Ctrl|Shift|Alt)\+)*)(F\d+|Enter|Home|End|Space|Delete|Up|Down|Left|Right|[A-Z.])$')
X11 = {'Enter': 'Return', 'Space': 'space', '.': 'period'}
BEHAVIOUR = '@print Motor\n.\nStart=1\nStart=0\n.\nStop=1\nStop=0\n'
SEALED = ['Motor=0', 'Motor=1', 'Motor=1', 'Motor=1', 'Motor=0', 'Motor=0']


def key_of(span):
    """The name that xdotool has for a key; None: it is a text."""
    found = KEY.match(span)
    if not found:
        return None
    name = X11.get(found[2], found[2])
    return found[1].lower() + (name.lower() if len(name) == 1 else name)


def steps(letter):
    """The keys and texts of a section, a list for each step."""
    section = re.search(r'^## %s\. .*?(?=^##? )' % letter, TUTORIAL, re.M | re.S)[0]
    return [re.findall('`([^`]+)`', step) for step in re.findall(r'^\d+\. (.*?): ', section, re.M)]


def press(editor, step):
    listed = False
    for span in step:
        key = key_of(span)
        if key == 'ctrl+k':
            listed = editor.list_commands()
        elif key:
            editor.keys(key)
        else:
            editor.type(span)
        if key in ('shift+F5', 'F5', 'F6', 'F7'):
            editor.opened()
        elif listed and not key:
            until(lambda: not editor.all('About Rungboard'), 'that command alone')


def follow(editor, letter, *came):
    """Does the steps of a section and checks the result of each."""
    todo = steps(letter)
    assert len(todo) == len(came), '%s has %d steps, not %d' % (letter, len(todo), len(came))
    for step, comes in zip(todo, came):
        press(editor, step)
        comes()


def element(editor, *parts):
    return lambda: editor.element(*parts) and editor.gone()


def drawn(editor):
    """The result of each step of B."""
    return (element(editor, 'Rung 1, NO', 'Start, %IX0.0'), element(editor, 'Rung 1, NC', 'Stop, %IX0.1'),
            element(editor, 'Rung 1, COIL', 'Motor, %QX0.0'), element(editor, 'Rung 1, NO', 'Motor, %QX0.0'))


def begin(screen):
    """An editor without a file, whose dialogs start in an empty folder."""
    os.mkdir(os.path.join(screen.home, 'work'))
    os.chdir(os.path.join(screen.home, 'work'))
    editor = Editor(screen)
    editor.focus_on('New project')
    return editor


def named(editor, name):
    """A file dialog with that name in its line, which has the focus."""
    def look():
        node = editor.focused()
        return node and node.role == ROLES['text'] and node.text() == name
    return lambda: until(lambda: len(editor.windows()) == 2 and look(), 'the dialog with ' + name)


def picture(name):
    with open(os.path.join(ROOT, 'docs', 'tutorial', name + '.rung')) as file:
        return file.read()


def draw(editor):
    follow(editor, 'A', lambda: until(lambda: not editor.all('Samples, opened as copies'), 'the sheet'))
    editor.to_sheet()
    editor.says('no problems')
    follow(editor, 'B', *drawn(editor))
    editor.says('no problems')


def judge(editor):
    def fewer():
        until(lambda: not editor.all('COIL', 'table cell'), 'the coil to go')
        editor.says('rung has no output')

    def back():
        editor.element('Rung 1, COIL', 'Motor')
        editor.says('no problems')
    follow(editor, 'C', fewer, lambda: editor.says('Rung 1 · column A'), back)


def simulate(editor):
    def state(start, stop, motor):
        def look():
            editor.element('Rung 1, NO', 'Start', start)
            editor.element('Rung 1, NC', 'Stop', stop)
            editor.element('Rung 1, COIL', motor)
        return look

    def forced():
        editor.element('Rung 1, COIL', ', on, forced')
        editor.shot('tutorial-forced')

    def released():
        until(lambda: not editor.all('forced', 'table cell'), 'the force to go')
        editor.element('Rung 1, COIL', ', off')
    follow(editor, 'E', lambda: editor.says('SIMULATION'), state('closed', 'closed', ', on'),
           state('open', 'closed', ', on'), state('open', 'open', ', off'),
           lambda: editor.says('No power: Start is FALSE'), forced, released,
           lambda: until(lambda: not editor.all('SIMULATION'), 'the end of it'))


def newcomer(screen):
    """its steps from the first to the last, by keyboard alone: drawn, checked, saved, simulated, run"""
    editor = begin(screen)
    draw(editor)
    judge(editor)

    def saved():
        until(lambda: len(editor.windows()) == 1 and os.path.exists('motor.rung'), 'the file')
        editor.to_sheet()
    follow(editor, 'D', named(editor, 'program.rung'), saved)
    with open('motor.rung') as file:
        text = file.read()
    assert text == picture(PICTURES[-1]) and '```rung motor.rung\n' + text + '```' in TUTORIAL, text
    check('motor.rung')
    assert lines('motor.rung', BEHAVIOUR) == SEALED
    simulate(editor)

    def mapped():
        until(lambda: os.path.exists('motor.io'), 'the map')
        editor.find('%QX0.0, Driver', 'text')

    def runs():
        editor.says('ON THIS MACHINE')
        until(lambda: [node for node in editor.all('RUN', 'label') if node.name == 'RUN'], 'the page Board')
        editor.shot('tutorial-board')

    def ended():
        editor.find('OFF', 'label')
        until(lambda: not editor.all('ON THIS MACHINE'), 'its end')
    follow(editor, 'G', named(editor, 'motor.io'), mapped, runs, ended)


def pictured(screen):
    """the drawing after each step equals the tutorial's picture"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()

    def saved(name, comes):
        def look():
            comes()
            text = editor.save(path)
            assert text == picture(name), text
        return look
    follow(editor, 'B', *map(saved, PICTURES, drawn(editor)))


def by_names(screen):
    """F5, F6 and F7 ask for names alone; Ctrl+Z undoes, Ctrl+Shift+Z redoes"""
    for key in 'F5', 'F6', 'F7', 'Ctrl+Z', 'Ctrl+Shift+Z':
        assert '`%s`' % key in TUTORIAL
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    came = drawn(editor)
    press(editor, ['F5', 'Start', 'Enter'])
    came[0]()
    press(editor, ['F6', 'Stop', 'Enter'])
    came[1]()
    press(editor, ['F7', 'Motor', 'Enter'])
    came[2]()
    press(editor, ['Ctrl+Z'])
    until(lambda: not editor.all('COIL', 'table cell'), 'the coil to go')
    press(editor, ['Ctrl+Shift+Z'])
    came[2]()
    assert editor.save(path) == picture('3-coil')


def by_mouse(screen):
    """F: the same with the mouse: drawn, saved, simulated"""
    path = new_file(screen)
    editor = Editor(screen, path)

    def put(tag, name, y, column):
        node = until(lambda: [node for node in editor.all(role='push button', below=editor.palette)
                              if tag in node.name], 'the tile ' + tag)[0]
        editor.drag(node, editor.grid(y, column))
        editor.opened()
        editor.entry(name)
    put('closed while TRUE', 'Start', 60, 0)
    put('closed while FALSE', 'Stop', 60, 1)
    put('TRUE while powered', 'Motor', 60, 5)
    editor.drag(editor.wire_end(60, 0, 10), editor.wire_end(60, 1, 10))
    editor.says('This branch is empty')
    put('closed while TRUE', 'Motor', 60 + 84, 0)
    editor.click(editor.find('Save', 'push button'))
    until(lambda: open(path).read() == picture(PICTURES[-1]), 'it to be saved')
    assert lines(path, BEHAVIOUR) == SEALED
    editor.click(editor.find('Simulate'))
    editor.says('SIMULATION')
    editor.shot('tutorial-simulate')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    editor.element('Rung 1, COIL', ', on')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'closed')))
    editor.element('Rung 1, NO', 'Start', 'open')
    editor.element('Rung 1, COIL', ', on')
    editor.click(editor.find('Input Stop, %IX0.1', 'check box'))
    editor.element('Rung 1, COIL', ', off')


main([newcomer, pictured, by_names, by_mouse])
