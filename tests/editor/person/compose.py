#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""compose - characters without a key: dead keys, a compose key, code points."""
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402


def keyboard(screen):
    """Dead keys by AltGr, Compose by Menu. xdotool maps a missing key for a moment only; a busy machine reads it
    too late."""
    if shutil.which('setxkbmap'):
        sh('setxkbmap', '-layout', 'us', '-variant', 'altgr-intl', '-option', 'compose:menu')
    return screen


def line(editor):
    """The text of the entry at the cursor."""
    return until(editor.asked, 'an entry')[0].text()


def take(editor):
    editor.keys('Return')
    editor.gone()


def on_the_sheet(screen):
    """a composed character begins the entry on a sheet: é by a dead key, ø by Compose, 阀 by its code point"""
    path = new_file(screen)
    editor = Editor(keyboard(screen), path)
    editor.to_sheet()
    editor.keys('dead_acute')
    editor.shot('composing')
    editor.keys('e')
    until(lambda: line(editor) == 'é', 'é in the entry')
    editor.type('toile')
    take(editor)
    editor.keys('Multi_key', 'slash', 'o')  # a slash alone would negate
    until(lambda: line(editor) == 'ø', 'ø in the entry')
    take(editor)
    editor.keys('ctrl+shift+u', '9', '6', '0', '0', 'space')  # a blank alone would change the kind
    until(lambda: line(editor) == '\u9600', '阀 in the entry')
    take(editor)
    editor.entry('OUT Motor')
    text = editor.save(path)
    assert '| NO étoile | NO ø | NO \u9600 | COIL Motor |' in ' '.join(text.split()), text
    check(path)
    script = '@print Motor\nétoile=1\nø=1\n\u9600=1\nø=0\n'
    assert lines(path, script) == ['Motor=0', 'Motor=0', 'Motor=1', 'Motor=0']


def given_up(screen):
    """a composition that is cancelled changes nothing; keys are verbs again"""
    path = new_file(screen)
    editor = Editor(keyboard(screen), path)
    editor.entry('Start')
    editor.keys('Home', 'ctrl+shift+u', '9', '6', 'Escape')
    editor.keys('slash', 'Right')
    editor.entry('OUT Motor')
    text = editor.save(path)
    assert '| NC Start | COIL Motor |' in ' '.join(text.split()), text
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=1', 'Motor=0']


def in_the_entry(screen):
    """composing works in the entry and in the line of a label"""
    path = new_file(screen)
    editor = Editor(keyboard(screen), path)
    editor.type('T')
    editor.opened()
    editor.keys('dead_diaeresis', 'u')
    editor.type('r')
    until(lambda: line(editor) == 'Tür', 'ü in the entry')
    take(editor)
    editor.keys('ctrl+l')
    editor.opened()
    editor.keys('dead_circumflex', 'o')
    take(editor)
    editor.entry('OUT Motor')
    text = editor.save(path)
    assert '| NO Tür | COIL Motor |' in ' '.join(text.split()) and 'RUNG ô' in text, text
    check(path)
    assert lines(path, '@print Motor\nTür=1\nTür=0\n') == ['Motor=1', 'Motor=0']


main([on_the_sheet, given_up, in_the_entry])
