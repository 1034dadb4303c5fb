#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""dialogs - each can be cancelled with Esc, and the sheet has the focus again."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
'''
# key, and what is seen then
DIALOGS = [
    ('ctrl+o', 'Open'), ('ctrl+shift+s', 'Save as'), ('F2', 'Rename everywhere'), ('ctrl+g', 'Go to rung'),
    ('F1', None), ('ctrl+p', 'Print'),
]
# popups of the window itself
POPUPS = ['F8', 'F5', 'Return', 'ctrl+shift+t', 'ctrl+l', 'semicolon', 'ctrl+k', 'ctrl+f', 'ctrl+h']


def dialogs(screen):
    """dialogs: Esc cancels, nothing is changed, the sheet has the focus"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    for key, _ in DIALOGS:
        before = len(editor.windows())
        editor.keys(key)
        until(lambda: len(editor.windows()) > before, 'the dialog of ' + key)
        editor.keys('Escape')
        until(lambda: len(editor.windows()) == before, 'the end of the dialog of ' + key)
        editor.to_sheet()
    editor.says('no problems')
    assert open(path).read() == PROJECT
    assert not editor.all('•')


def popups(screen):
    """popups of the window: Esc closes them, nothing is changed, the sheet has the focus"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    for key in POPUPS:
        editor.keys(key)
        until(lambda: not editor.sheet().has(12), 'what %s opens' % key)
        editor.keys('Escape')
        editor.to_sheet()
    assert not editor.all('•')
    assert len(editor.cells()) == 2


def give_back(screen):
    """Esc gives a rung back as the cursor found it; a palette click leaves the focus here"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash', 'Right')
    editor.entry('NC Motor')
    until(lambda: len(editor.cells()) == 3, 'the contact')
    editor.keys('Escape')
    until(lambda: len(editor.cells()) == 2, 'the rung as it was')
    assert any('NO' in name for name in editor.cells()), editor.cells()
    editor.click(editor.tile('closed while FALSE'))
    editor.opened()
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('ctrl+s')
    until(lambda: not editor.all('•'), 'the file to be saved')
    check(path)
    assert 'NO Start | COIL Motor' in open(path).read()


def close(screen):
    """closing with changes asks; Esc keeps the window, Discard ends it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash')
    editor.find('•')
    editor.keys('ctrl+w')
    until(lambda: len(editor.windows()) == 2, 'the question')
    editor.shot('dialogs-close')
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1, 'the window to stay')
    editor.to_sheet()
    editor.keys('ctrl+w')
    until(lambda: len(editor.windows()) == 2, 'the question')
    editor.reply('Discard')
    until(lambda: editor.process.poll() is not None, 'the end')
    assert editor.process.returncode == 0, editor.logged()
    assert open(path).read() == PROJECT


def commands(screen):
    """in the list of all commands the one that Enter does is seen, however far down it is"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+k')
    until(lambda: len(editor.windows()) == 2, 'all commands')
    editor.keys(*['Down'] * 130)

    def seen():
        for node in editor.all(role='list item'):
            if node.has(23):  # selected
                _, y, _, height = node.box()
                return node.name == 'About Rungboard' and 40 <= y and y + height <= 520
        return False
    until(seen, 'the chosen command in the window')
    editor.shot('dialogs-commands')
    editor.keys('Escape')


main([dialogs, popups, give_back, close, commands])
