#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""manual - the manual in its window: links, back, search, find, and F1 at places of the editor."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, sh, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG
  | NO Start | TON Delay PT:=T#5s | COIL Lamp |
END_PROGRAM

PROGRAM Tank SFC
  INITIAL_STEP Idle:
  END_STEP
  STEP Fill:
    %QX0.2(N);
  END_STEP
  TRANSITION FROM Idle TO Fill := Start; END_TRANSITION
  TRANSITION FROM Fill TO Idle := %IX0.3; END_TRANSITION
END_PROGRAM
'''


def shows(editor, heading):
    """Waits until the manual shows a heading at its top, where its cursor is. Tables before it count one each."""
    def look():
        node = next(iter(editor.all('Page of the manual', 'text')), None)
        if not node:
            return False
        caret = int(editor.bus.call_blocking(editor.name, node.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             ('org.a11y.atspi.Text', 'CaretOffset')))
        return '\n%s\n' % heading in '\n' + node.text()[max(0, caret - 150):caret + len(heading) + 1]
    until(look, 'the manual at "%s"' % heading)


def places(screen):
    """F1 opens the page about the element, the step, the transition, the symbols and the palette"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.brought('F1')
    shows(editor, 'NO: closed while TRUE')
    editor.shot('manual-word')
    for keys, heading in ((['Right'], 'TON: on-delay timer'), (['ctrl+Page_Down'], 'How it is written'),
                          (['Down'], 'What a scan does'), (['ctrl+Page_Down'], 'The symbol table')):
        editor.front()
        editor.keys(*keys)
        editor.keys('F1')
        shows(editor, heading)
        editor.shot('manual-' + heading[:5])
    editor.front()
    editor.keys('ctrl+Page_Up', 'ctrl+Page_Up', 'shift+ctrl+e')
    editor.keys('F1')
    shows(editor, 'Drawing with the pointer')


def pages(screen):
    """from the welcome page to the tutorial; links, back and forward, search in all pages, find in one; Escape closes"""
    editor = Editor(screen)
    row = editor.focus_on('New project')
    while 'Tutorial' not in row.name:
        editor.keys('Down')
        row = editor.focus_on(role='list item', but=row)
    window = editor.brought('Return', 'From an empty sheet')
    shows(editor, 'From an empty sheet to a running board')
    editor.shot('manual-tutorial')
    editor.keys('Tab', 'Return')
    shows(editor, 'The editor')
    editor.shot('manual')
    editor.keys('Tab', 'Return')
    shows(editor, 'The rung file')
    editor.keys('alt+Left')
    shows(editor, 'The editor')
    editor.keys('alt+Right')
    shows(editor, 'The rung file')
    editor.keys('ctrl+f')
    editor.type('end_configuration')
    editor.says('1 of ')
    editor.keys('Return')
    editor.says('2 of ')
    editor.shot('manual-find')
    editor.keys('Escape', 'ctrl+shift+f')
    editor.type('seal-in')
    editor.find('This is a motor with seal-in', 'list item')
    editor.shot('manual-search')
    editor.keys('Return')
    until(lambda: 'seal-in' in editor.find('Page of the manual', 'text').text(), 'a page with the text')
    editor.keys('Escape', 'Escape')
    until(lambda: window not in editor.windows(), 'the end of the manual')
    editor.brought(lambda: editor.command('Manual'), 'The editor')
    shows(editor, 'The editor')


def clipboard():
    return subprocess.run(['timeout', '10', 'xclip', '-selection', 'clipboard', '-o'], capture_output=True, text=True).stdout


def found(editor, text):
    """Finds a text in the page; the cursor is there."""
    editor.keys('ctrl+f', 'ctrl+a')
    editor.type(text)
    editor.says('1 of ')
    editor.keys('Escape')
    until(lambda: not [node for node in editor.all('Find in this page', 'text') if node.box()[2] > 0], 'the line to close')


def copied(screen):
    """tables are selected and copied with the text, alone by a key; so is code, and by the button over it"""
    editor = Editor(screen)
    window = editor.brought(lambda: editor.command('Manual'), 'The editor')
    shows(editor, 'The editor')
    editor.keys('ctrl+a', 'ctrl+c')
    until(lambda: '\ta coil, in the last column\n' in clipboard(), 'a row of a table between the texts')
    text = clipboard()
    assert '\ufffc' not in text and 'The editor\n' in text, text[:300]
    editor.shot('manual-selected')
    found(editor, 'you get')
    editor.keys('ctrl+shift+c')
    until(lambda: clipboard().startswith('you type\tyou get\n'), 'the table alone')
    found(editor, 'RUNGBOARD 1')
    editor.keys('ctrl+shift+c')
    until(lambda: clipboard().startswith('RUNGBOARD 1\n'), 'the code alone')
    code = clipboard()
    assert code in text, code
    editor.put_clipboard('other')
    at = dict(line.split('=') for line in sh('xdotool', 'getwindowgeometry', '--shell', window).split())
    x, y, width, height = editor.find('Page of the manual', 'text').box()

    def over():
        """The button, wherever in the middle of the page the code is."""
        for part in range(10, 60, 2):
            sh('xdotool', 'mousemove', str(int(at['X']) + x + width // 2), str(int(at['Y']) + y + height * part // 100))
            shown = [node for node in editor.all('Copy', 'push button') if node.box()[2] > 0]
            if shown:
                return shown[0]
        return None

    def taken():
        """Clicks the button where it rests, as often as it has moved meanwhile: it is placed a frame after it is shown."""
        if clipboard() != 'other':
            return True
        button = over()
        place = button and button.box()
        sh('sleep', '0.1')
        if place and place == button.box():
            left, top, wide, high = place
            editor.click((int(at['X']) + left + wide // 2, int(at['Y']) + top + high // 2))
            sh('sleep', '0.1')
        return None
    until(taken, 'the code below the button')
    editor.shot('manual-copy')
    assert clipboard() in text, clipboard()


places.quick = 'editor-gtk/window'
TESTS = [places, pages, copied]

if __name__ == '__main__':
    main(TESTS)
