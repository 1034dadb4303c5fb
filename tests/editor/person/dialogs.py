#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""dialogs - each is cancelled with Esc, and the sheet has the focus again."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, check, main, new_file, until, sh  # noqa: E402
from projects import ONE_RUNG  # noqa: E402

MAP = 'BOARD "Desk"\n%IX0.0  gpio  line=NOWHERE\n%QX0.0  sim  safe=0\n'
OTHER = ONE_RUNG.replace('Main', 'Other').replace('Motor', 'Pump')
# the key, and a text of the dialog
DIALOGS = [
    ('ctrl+o', 'Open'), ('ctrl+shift+s', 'Save as'), ('F2', 'Rename everywhere'), ('ctrl+g', 'Go to rung'),
    ('ctrl+question', None), ('ctrl+p', 'Print'),
]
# popups of the window
POPUPS = ['F8', 'F5', 'Return', 'ctrl+shift+t', 'ctrl+l', 'semicolon', 'ctrl+k', 'ctrl+f', 'ctrl+h']


def dialogs(screen):
    """dialogs: Esc cancels, nothing changes, the sheet has the focus"""
    path = new_file(screen, ONE_RUNG)
    editor = Editor(screen, path)
    editor.to_sheet()
    for key, _ in DIALOGS:
        editor.brought(key)
        editor.keys('Escape')
        until(lambda: len(editor.windows()) == 1, 'the end of the dialog of ' + key)
        editor.to_sheet()
    editor.says('no problems')
    assert open(path).read() == ONE_RUNG
    assert not editor.all('•')


def popups(screen):
    """popups of the window: Esc closes them, nothing changes, the sheet has the focus"""
    path = new_file(screen, ONE_RUNG)
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
    """Esc restores a rung as the cursor found it; a click on the palette leaves the focus here"""
    path = new_file(screen, ONE_RUNG)
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
    """closing with changes asks; Esc keeps the window, Discard closes it"""
    path = new_file(screen, ONE_RUNG)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash')
    editor.find('•')
    editor.brought('ctrl+w')
    editor.shot('dialogs-close')
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1, 'the window to stay')
    editor.to_sheet()
    editor.keys('ctrl+w')
    until(lambda: len(editor.windows()) == 2, 'the question')
    editor.reply('Discard')
    until(lambda: editor.process.poll() is not None, 'the end')
    assert editor.process.returncode == 0, editor.logged()
    assert open(path).read() == ONE_RUNG


def commands(screen):
    """the selected row in the list of all commands is visible, however far down it is"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    editor.to_sheet()
    editor.list_commands()
    editor.keys(*['Down'] * 220)

    def seen():
        for node in editor.all(role='list item'):
            if node.has(23):  # selected
                _, y, _, height = node.box()
                return node.name == 'About Rungboard' and 40 <= y and y + height <= 520
        return False
    until(seen, 'the chosen command in the window')
    editor.shot('dialogs-commands')
    editor.keys('Escape')


def kept(editor):
    """Title and files: a cancelled dialog must not change them."""
    home, files = editor.screen.home, {}
    for name in os.listdir(home):
        path = os.path.join(home, name)
        if os.path.isfile(path) and not name.startswith(('.', 'editor-')):  # editor-….log is of desk.py
            with open(path, 'rb') as file:
                files[name] = file.read()
    return editor.all(role='frame')[0].name, len(editor.all('•')), files


def escape(editor, before, picture):
    """Esc; title and files are as before."""
    editor.shot('dialogs-' + picture)
    until(editor.focused, 'the keys')
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1, 'the end of the dialog')
    assert kept(editor) == before, '%s: %s, not %s' % (picture, kept(editor), before)


def writers(screen):
    """commands that write a file: Esc in the dialog writes none"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    editor.to_sheet()
    before = kept(editor)
    for title, offered in (('Export as PDF', 'new.pdf'), ('New I/O map', 'new.io'),
                           ('Export as ClassicLadder', 'new.clprj'), ('Export symbols', 'new.csv')):
        editor.brought(lambda: editor.command(title), title)
        until(lambda: editor.focused() and editor.focused().text() == offered, 'the name ' + offered)
        escape(editor, before, offered)
        editor.to_sheet()


def replaced(screen):
    """Esc at "replace the file?" keeps the file; Esc in find and replace changes nothing"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    other = new_file(screen, OTHER, 'other.rung')
    editor.to_sheet()
    before = kept(editor)
    # The file chooser asks by itself and stays open; the editor asks where it adds the ending.
    for name, question, windows in (other, 'Do you want to replace it?', 3), (other[:-5], 'Replace the file?', 2):
        editor.brought('ctrl+shift+s', 'Save as')
        editor.type_path(name)
        editor.brought('Return')
        editor.find(question)
        until(lambda: len(editor.windows()) == windows, 'the question alone')
        if windows > 2:
            editor.keys('Escape')
            until(lambda: len(editor.windows()) == 2, 'the chooser')
        escape(editor, before, 'replace-%d' % windows)
        editor.to_sheet()
    editor.keys('ctrl+h')
    editor.focus_on(role='text')
    editor.type('Motor')
    editor.says('2 hits')
    editor.into('Replace with')
    editor.type('Engine')
    escape(editor, before, 'find-replace')
    editor.to_sheet()
    assert any('Motor' in name for name in editor.cells()), editor.cells()


def imported(screen):
    """import from another project: Esc in the file chooser, and in the choice of parts; Enter in a check box imports"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    other = new_file(screen, OTHER, 'other.rung')
    editor.click([node for node in editor.all('Programs', 'label') if node.name == 'Programs'][0])
    before = kept(editor)

    def item():
        """The focused item of the menu."""
        return any(node.has(12) for node in editor.all('Import from another project', 'menu item'))
    for chosen in False, True:
        editor.keys('Menu')
        editor.find('Import from another project', 'menu item')
        editor.step_to(item, 'Down', 'the item')
        editor.brought('Return', 'Import from another project')
        if chosen:
            editor.type_path(other)
            editor.keys('Return')
            editor.find('Other', 'check box')
        escape(editor, before, 'import-%d' % chosen)
    assert not editor.all('Other', 'label')
    editor.give_path(other, lambda: editor.command('Import from another project'), 'Import from another project')
    editor.step_to(lambda: editor.find('Other', 'check box').has(12), 'Tab', 'the focus on the check box')
    assert editor.find('Other', 'check box').has(4), 'the only program is not chosen'
    editor.keys('Return')
    until(lambda: [node for node in editor.all('Other', 'label') if node.name == 'Other'], 'the program')
    editor.element('Pump')  # what was imported is in front


def preview(screen):
    """the print preview, also from the print dialog, needs no viewer; it has paper, zoom and pages, and follows edits"""
    editor = Editor(screen, os.path.join(ROOT, 'ladders', 'garage-door.rung'), PATH='/nowhere')
    editor.to_sheet()
    editor.brought('ctrl+p')
    editor.find('Preview', 'push button').press()
    editor.find('Page 1 of ', 'picture')
    until(lambda: len(editor.windows()) == 1, 'the end of the print dialog')
    editor.shot('dialogs-preview')
    upright = editor.find('Page 1 of ', 'label').name
    editor.click(editor.find('Landscape'))
    until(lambda: editor.find('Page 1 of ', 'label').name != upright, 'pages across')
    editor.shot('dialogs-preview-across')
    editor.click(editor.find('Landscape'))
    until(lambda: editor.find('Page 1 of ', 'label').name == upright, 'upright pages')
    editor.click(editor.find('Zoom in', 'push button'))
    x, y, width, height = editor.place(editor.find('Page 1 of ', 'picture'))
    sh('xdotool', 'mousemove', str(x + 300), str(y + 200), 'click', '--repeat', '30', '5')
    until(lambda: 'Page 1 of' not in editor.find('Page ', 'label').name, 'another page')
    editor.keys('ctrl+Page_Up', 'ctrl+Page_Up', 'ctrl+Page_Up')
    editor.to_sheet()
    editor.keys('ctrl+a', 'ctrl+a', 'ctrl+Delete')
    until(lambda: not editor.all('MotorOk', 'table cell'), 'the rungs to go')
    editor.command('Print preview')
    until(lambda: not editor.find('Page ', 'label').name.endswith(upright[-2:]), 'fewer pages')


def board(screen):
    """run on this machine: Esc at the question starts and saves nothing"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    new_file(screen, MAP, 'new.io')
    editor.to_sheet()
    for change in (), ('slash',):  # questions about pins and about unsaved work
        editor.keys(*change)
        until(lambda: bool(editor.all('•')) == bool(change), 'the mark of a change')
        before = kept(editor)
        editor.brought(lambda: editor.command('Run on this machine'))
        editor.find('Run on this machine?')
        escape(editor, before, 'board-%d' % len(change))
        editor.to_sheet()
        began = subprocess.run(['pgrep', '-P', str(editor.pid), 'ladderd'], capture_output=True, text=True)
        assert not began.stdout and not editor.all('Started with'), 'it ran'


dialogs.quick = 'editor-gtk/kit'
popups.quick = 'editor-gtk/kit/gtk48'
main([dialogs, popups, give_back, close, commands, writers, replaced, imported, preview, board])
