#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""foreign - projects of other tools: PLCopen XML, LDmicro, OpenPLC Editor: the report, where its lines lead, the
original beside the result, dropping, choosing, saving."""
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from classic import can_drag, source  # noqa: E402
from desk import LADDER, ROOT, Editor, check, main, new_file, sh, until  # noqa: E402

XML = os.path.join(ROOT, 'tests', 'editor', 'person', 'foreign.xml')
LOST = 'the element unheard "of" is left out'


def reads_xml():
    return 'taken:' in sh(LADDER, 'import', XML)


def opened(screen, path=XML, **env):
    own = os.path.join(screen.home, os.path.basename(path))
    if os.path.isdir(path):
        shutil.copytree(path, own)
    else:
        shutil.copy(path, own)
    editor = Editor(screen, own, **env)
    until(lambda: editor.all(os.path.basename(path) + ': '), 'the message')
    return editor


def original(screen):
    """the report of PLCopen XML; a ladder and its networks beside their originals, which follow the cursor"""
    editor = opened(screen)
    editor.click(editor.find('Show report', 'push button'))
    editor.find(LOST, 'label')
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+Home')
    editor.find('Original in line ')
    editor.shot('foreign-ladder')
    editor.keys('Next', 'ctrl+End')
    editor.find('Original in line 26')
    editor.keys('ctrl+Page_Down')
    editor.find('Original in line 39')
    editor.shot('foreign-networks')
    editor.keys('Insert')
    editor.find('There is no original of this place')


def saved(screen):
    """saved as a rung file; the XML is unchanged, and the file does the same"""
    editor = opened(screen)
    with open(os.path.join(screen.home, 'foreign.xml'), 'rb') as file:
        before = file.read()
    editor.to_sheet()
    path = os.path.join(screen.home, 'foreign.rung')
    editor.give_path(path, 'ctrl+shift+s')
    until(lambda: os.path.exists(path), 'the file')
    check(path)
    with open(os.path.join(screen.home, 'foreign.xml'), 'rb') as file:
        assert file.read() == before
    script = new_file(screen, '@print Pump Late Valve\nStart=1\nStart=0\n. x4\n', 'script')
    assert sh(LADDER, 'trace', '--changes', path, script) == sh(LADDER, 'trace', '--changes', XML, script)


if __name__ == '__main__':
    main([original, saved] if reads_xml() else [])
