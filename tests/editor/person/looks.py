#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""looks - the window in the dark, with more contrast and on a small screen is used as any other."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1
PROJECT "Pump station"

VAR
  Start AT %IX0.0 : BOOL; (* push button, normally open *)
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL; (* contactor of the pump *)
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG "Motor start and stop"
(* Self-holding: runs until Stop is pushed *)
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^ |
RUNG "Run delay"
  | NO Motor | TON Delay PT:=T#5s | COIL Lamp |
RUNG
  | NO Nothing | COIL Lamp |
END_PROGRAM
'''
GOOD = PROJECT.replace('RUNG\n  | NO Nothing | COIL Lamp |\n', '')


def draw(screen, name, **env):
    path = new_file(screen, GOOD)
    editor = Editor(screen, path, **env)
    editor.to_sheet()
    editor.keys('ctrl+End', 'Insert')
    editor.entry('XIO Lamp')
    editor.entry('OUT Idle')
    editor.shot(name)
    editor.save(path)
    check(path)
    assert lines(path, '@print Idle\nStart=1\n') == ['Idle=1']
    return editor


def dark(screen):
    """a rung drawn in the dark"""
    draw(screen, 'looks-dark', ADW_DEBUG_COLOR_SCHEME='prefer-dark')


def light(screen):
    """a project with mistakes: they are listed, and the next one is found by a key"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.says('1 error')
    editor.keys('ctrl+period')
    until(lambda: editor.all('Rung 3'), 'the rung of the mistake')
    editor.shot('looks-light')


def small(screen):
    """a rung drawn on a screen of 1024x700"""
    editor = draw(screen, 'looks-small')
    _, _, width, height = editor.place(editor.sheet())
    assert width >= 600 and height >= 250, 'the sheet is %d x %d' % (width, height)


def high(screen):
    """more contrast in the dark: the sheet is black, also where no rung is"""
    editor = draw(screen, 'looks-high', ADW_DEBUG_COLOR_SCHEME='prefer-dark', ADW_DEBUG_HIGH_CONTRAST='1')
    left, top, width, height = editor.place(editor.sheet())
    for x in left + 6, left + width - 60:
        ground = subprocess.run(['import', '-window', 'root', '-crop', '20x30+%d+%d' % (x, top + height // 3),
                                 '-depth', '8', 'rgb:-'], capture_output=True, check=True).stdout
        # The line below a rung is #8b8b92.
        assert set(ground) <= {0, 0x8b, 0x92} and ground.count(0) > 1500, set(ground)


small.size = '1024x700x24'
main([light, dark, high, small])
