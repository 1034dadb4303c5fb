#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chinese - a project in Chinese: names, titles and comments, in every list."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1
PROJECT "水泵站"

VAR
  启动 AT %IX0.0 : BOOL; (* 启动按钮，常开 *)
  停止 AT %IX0.1 : BOOL; (* 停止按钮 *)
  电机 AT %QX0.0 : BOOL; (* 水泵电机的接触器 *)
END_VAR

PROGRAM 主程序 LD
RUNG "电机的启动和停止"
(* 自保持电路：按下启动按钮后电机一直运行，直到按下停止按钮 *)
  | NO 启动 | NC 停止 | COIL 电机 |
END_PROGRAM
'''


def project(screen):
    """a Chinese project: a branch with a Chinese name, and a new one"""
    path = new_file(screen, PROJECT, '水泵站.rung')
    editor = Editor(screen, path)
    assert any('启动' in name for name in editor.cells()), editor.cells()
    editor.to_sheet()
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('电机')
    editor.shot('chinese')
    text = editor.save(path)
    assert '电机 ^' in text or '电机' in text.split('NO 启动')[1], text
    check(path)
    assert lines(path, '@print 电机\n启动=1\n启动=0\n停止=1\n') == ['电机=1', '电机=1', '电机=0']
    editor.keys('Insert', 'F8')
    editor.opened()
    editor.entry('报警')
    editor.keys('End', 'F7')
    editor.opened()
    editor.entry('报警灯')
    until(lambda: any('报警灯' in name for name in editor.cells()), 'the new coil')
    editor.keys('ctrl+alt+s')
    editor.shot('chinese-symbols')
    assert '报警灯 AT %QX0.1 : BOOL;' in editor.save(path)
    check(path)
    assert lines(path, '@print 报警灯\n报警=1\n') == ['报警灯=1']


main([project])
