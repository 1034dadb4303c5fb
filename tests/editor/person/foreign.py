#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""foreign - projects of other tools: PLCopen XML, LDmicro, OpenPLC Editor: the report, where its lines lead, the
original beside the result, dropping, choosing, saving."""
import os
import re
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from classic import can_drag, source  # noqa: E402
from desk import LADDER, ROOT, Editor, check, main, new_file, sh, until  # noqa: E402

XML = os.path.join(ROOT, 'tests', 'editor', 'person', 'foreign.xml')
LDMICRO = os.path.join(ROOT, 'tests', 'fuzz', 'corpus', 'ldmicro', 'pump.ld'), 'pump.ld'
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


def plant(screen):
    """The project of docs/from-openplc.md."""
    with open(os.path.join(ROOT, 'docs', 'from-openplc.md')) as page:
        files = re.findall(r'^```text (\S+)\n(.*?)^```', page.read(), re.M | re.S)
    for name, text in files:
        path = os.path.join(screen.home, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        new_file(screen, text, name)
    return os.path.join(screen.home, files[0][0])


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


def chosen(screen):
    """a program of LDmicro and a project of OpenPLC Editor, chosen in Open: their reports, a line that leads to its place"""
    for path, name, taken, lines in (*LDMICRO, 'rungs: 4, elements: 12', [('Left out: it has no equivalent; a box', 'Rung 3')]), \
                                    (plant(screen), 'project.json', 'POUs: 1, variables: 2', []):
        editor = Editor(screen)
        editor.give_path(path, 'ctrl+o')
        until(lambda: editor.all(name + ': '), 'the message')
        editor.click(editor.find('Show report', 'push button'))
        line = editor.find('Taken: ', 'table row')
        assert taken in line.name, line.name
        editor.shot('foreign-' + name)
        for told, place in lines:
            editor.click(editor.find(told, 'table row'), count=2)
            editor.to_sheet()
            editor.says(place)
        editor.finish()


def dropped(screen):
    """dropped XML opens in this window, as a file of another tool"""
    path = shutil.copy(XML, screen.home)
    editor = Editor(screen)
    start = source(screen, path)
    editor.drag(start, editor.centre(editor.find('Project')))
    until(lambda: editor.all('foreign.xml: '), 'the message')
    until(lambda: any('Stop' in name for name in editor.cells()), 'the sheet')


if __name__ == '__main__':
    main([original, saved, chosen] + ([dropped] if can_drag() else []) if reads_xml() else [])
