#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""found - the hits of a search on each kind of sheet: yellow while the find bar is open, the current one stronger."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from contrast import SCALE, Picture, choose_contrast, faint  # noqa: E402
from desk import Editor, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp  AT %QX0.1 : BOOL; (* shows that Motor runs *)
END_VAR

PROGRAM Main LD
RUNG "Motor and lamp"
  | NO Start | COIL Motor |
RUNG
  | NO Motor | COIL Lamp |
RUNG
  | NO Lamp | COIL %QX0.2 |
END_PROGRAM

PROGRAM Net FBD
NETWORK
  %QX0.3 := AND(Motor, Lamp)
NETWORK "The Motor stands"
  %QX0.4 := NOT Motor
END_PROGRAM

PROGRAM Text ST
IF Motor THEN
  %QX0.5 := Lamp;
END_IF;
%QX0.6 := Motor OR Start;
END_PROGRAM

PROGRAM Chart SFC
INITIAL_STEP Rest:
END_STEP
STEP Run:
  Motor(N);
END_STEP
TRANSITION FROM Rest TO Run := Motor;
END_TRANSITION
TRANSITION FROM Run TO Rest := NOT Motor;
END_TRANSITION
ACTION Motor:
RUNG
  | NO Lamp | COIL %QX0.7 |
END_ACTION
END_PROGRAM
'''
YELLOW = {'light': (0xf9, 0xf0, 0x6b), 'dark': (0x3d, 0x34, 0x00), 'contrast': (0xf9, 0xf0, 0x6b)}
STRONG = {'light': (0xff, 0xd9, 0x8a), 'dark': (0x55, 0x30, 0x00), 'contrast': (0xff, 0xd9, 0x8a)}
ENOUGH = 100  # pixels, more than the edge of a letter could have


def seen(editor, theme):
    """Which grounds are on the screen: of hits, of the current one."""
    colors = Picture().colors(0, 0, 4000, 4000)
    return colors[YELLOW[theme]] > ENOUGH, colors[STRONG[theme]] > ENOUGH


def grounds(editor, theme, wanted, where):
    until(lambda: seen(editor, theme) == wanted, 'the grounds %s in %s' % (wanted, where))


def sheet(editor, theme, name, first):
    """All hits of a sheet are yellow; Return makes one stronger, others stay; Esc takes both away."""
    grounds(editor, theme, (False, False), name)
    editor.keys('ctrl+f')
    editor.type('Motor')
    editor.says('hits')
    grounds(editor, theme, (True, False), name)
    assert not (told := faint(editor, name, set())), '\n'.join(told)
    editor.keys('Return')
    editor.says(' of ')
    grounds(editor, theme, (True, True), name)
    editor.shot('found-%s-%s' % (theme, name))
    if first:  # what is typed decides, letter by letter
        editor.keys('ctrl+a')
        editor.type('Stert')
        editor.says('Nothing found')
        grounds(editor, theme, (False, False), name)
    until(lambda: editor.keys('Escape') or not [node for node in editor.all('Find', 'text') if node.name == 'Find'],
          'the bar to be closed')
    grounds(editor, theme, (False, False), name)


def sheets(screen, theme, **env):
    editor = Editor(screen, new_file(screen, PROJECT), GDK_SCALE=str(SCALE), **env)
    editor.to_sheet()
    if theme == 'contrast':
        choose_contrast(editor, 'Down')
        editor.to_sheet()
    for name in 'Main', 'Net', 'Text', 'Chart':
        if name != 'Main':
            editor.keys('ctrl+Page_Down')
        if name == 'Text':  # the search goes on behind the cursor
            editor.into('Text of the program')
            editor.keys('ctrl+Home')
        sheet(editor, theme, name, name == 'Main')
    editor.keys('ctrl+alt+s')
    editor.find('Add a symbol', 'push button')
    sheet(editor, theme, 'symbols', False)


def light(screen):
    """ladder, networks, text, chart and the table of symbols: all hits, the current one stronger, none afterwards"""
    sheets(screen, 'light', ADW_DEBUG_COLOR_SCHEME='prefer-light')


def dark(screen):
    """dark: the same"""
    sheets(screen, 'dark', ADW_DEBUG_COLOR_SCHEME='prefer-dark')


def contrast(screen):
    """high contrast: the same"""
    sheets(screen, 'contrast', GSETTINGS_BACKEND='keyfile', ADW_DEBUG_COLOR_SCHEME='prefer-light')


light.size = dark.size = contrast.size = '2880x1800x24'
if __name__ == "__main__": main([light, dark, contrast])
