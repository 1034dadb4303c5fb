#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chinese - a project in Chinese: names, titles and comments, in every list, and under the pointer."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402

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


def size(window):
    """Width and height, in px."""
    about = dict(re.findall(r'(Width|Height): +(\d+)', sh('xwininfo', '-id', window)))
    return int(about.get('Width', 0)), int(about.get('Height', 0))


def tip(screen):
    """a Chinese name under the pointer stands on one line"""
    editor = Editor(screen, new_file(screen, PROJECT, '水泵站.rung'))
    editor.to_sheet()
    row = until(lambda: [node for node in editor.all('主程序', 'label') if node.name == '主程序'], 'the program')[0]
    x, y = editor.centre(row)
    sh('xdotool', 'mousemove', str(x - 2), str(y), 'sleep', '0.1', 'mousemove', str(x), str(y))

    def shown():
        seen = sh('xdotool', 'search', '--onlyvisible', '--pid', str(editor.pid)).split()
        known = editor.windows()
        return [size(window) for window in seen if window not in known and size(window)[0] < 200]
    width, height = until(shown, 'the tooltip')[0]
    editor.shot('chinese-tip')
    assert width > height, 'the tooltip is %d x %d' % (width, height)


main([project, tip])
