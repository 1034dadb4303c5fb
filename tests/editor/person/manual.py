#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""manual - the manual in its window: links, back, search, find, and F1 at places of the editor."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, new_file, until  # noqa: E402

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


places.quick = 'editor-gtk/window'
TESTS = [places, pages]

if __name__ == '__main__':
    main(TESTS)
