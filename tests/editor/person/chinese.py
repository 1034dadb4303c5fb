#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""chinese - a project with Chinese names, titles and comments: in each list and under the pointer."""
import gettext
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, Chinese, Editor, check, lines, main, new_file, sh, until  # noqa: E402

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
HELD = PROJECT.replace('COIL 电机 |\n', 'COIL 电机 |\n  | NO 电机 ^|\n')
WRONG = HELD.replace('  停止 AT', '  启动 AT %IX0.2 : BOOL;\n  停止 AT').replace('NC 停止', 'NC 未声明')
LINE = 34  # px of a line of the timing chart
NAMES = 128  # px to the values, which are right of the names


def project(screen):
    """A Chinese project: a branch with a Chinese name, and a new name."""
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
    """a long Chinese name under the pointer, which the tree cuts, stands on one line"""
    name = '主程序' * 6
    editor = Editor(screen, new_file(screen, PROJECT.replace('主程序', name), '水泵站.rung'))
    editor.to_sheet()
    row = until(lambda: [node for node in editor.all(name, 'label') if node.name == name], 'the program')[0]
    width, height = editor.hover(row, lambda: [size(window) for window in editor.tips() if size(window)[0] < 400])[0]
    editor.shot('chinese-tip')
    assert width > height, 'the tooltip is %d x %d' % (width, height)


def pixels(x, y, width, height):
    """The lines of an area of the screen, each as the brightness of its pixels."""
    body = subprocess.run(['import', '-window', 'root', '-crop', '%dx%d+%d+%d' % (width, height, x, y), '-colorspace',
                           'gray', '-depth', '8', 'gray:-'], capture_output=True, check=True).stdout
    return [body[i:i + width] for i in range(0, len(body), width)]


def ink(editor, line):
    """The first and last line and column of a name in the timing chart whose pixels differ from the background."""
    x, y, _, _ = editor.place(editor.find('Timing chart, cursor'))
    rows = pixels(x, y + LINE * line, NAMES, LINE)
    upon = [(row, column) for row, data in enumerate(rows) for column, grey in enumerate(data)
            if abs(grey - rows[0][0]) > 80]
    return [edge(each) for each in zip(*upon) for edge in (min, max)]


def at_the_bottom(editor, text):
    """Is it in the status bar: the lowest of the window, one line high?"""
    node = editor.says(text)
    _, y, _, height = editor.place(node)
    _, top, _, whole = editor.place(editor.find(role='frame'))
    assert 0 <= top + whole - y - height < 20, (text, y, height, top + whole)


def listed(editor, said, name):
    """Cross reference, rename, log, status bar and timing chart. @said: a text in the editor's language."""
    path = os.path.join(editor.screen.home, '水泵站.rung')
    editor.to_sheet()
    editor.keys('End', 'shift+F12')
    for use, row, column in ('coil', 1, 'F'), ('read', 2, 'A'):
        place = said('%s, rung %d, row %d, column %s') % ('主程序', 1, row, column)
        editor.find('电机 %%QX0.0 %s, %s. 电机' % (said(use), place), 'table row')
        until(lambda place=place: [node for node in editor.all(place, 'label') if node.name == place], place)
    editor.shot('chinese-uses-' + name)
    editor.keys('F2')
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    editor.keys('ctrl+a')
    editor.type('水泵电机')
    editor.keys('Return')
    editor.to_sheet()
    text = editor.save(path)
    assert '  水泵电机 AT %QX0.0 : BOOL; (* 水泵电机的接触器 *)' in text and text.count(' 水泵电机 ') == 3, text
    check(path)
    script = '@print 水泵电机\n启动=1\n启动=0\n停止=1\n'
    assert lines(path, script) == ['水泵电机=1', '水泵电机=1', '水泵电机=0']
    editor.find('水泵电机 %%QX0.0 %s, ' % said('coil'), 'table row')
    editor.tab(said('Log'))
    log = [(said('system'), path), (said('operator'), said('Rename %s to %s') % ('电机', '水泵电机')), (said('system'), path)]

    def logged():
        return [tuple(line.split('\t')[1:]) for node in editor.all('Log', 'text') for line in node.text().splitlines()]
    until(lambda: [line for line in logged() if line in log] == log, 'the lines of the log')
    editor.shot('chinese-log-' + name)
    editor.keys('Home', 'ctrl+r')
    editor.tab(said('Timing chart'))
    contact = until(lambda: [node for node in editor.all('启动', 'table cell') if 'NO' in node.name], 'the contact')[0]
    editor.click(editor.middle(contact))
    at_the_bottom(editor, '启动 = TRUE')
    names = [until(lambda line=line: ink(editor, line), 'a name in the chart') for line in range(3)]
    editor.shot('chinese-timing-' + name)
    for top, bottom, left, right in names:
        assert 3 < top < bottom - 9 < LINE - 12 and 8 < left < right < NAMES - 8, names
    start, stop, motor = [right - left for _, _, left, right in names]
    assert abs(start - stop) < 5 and 1.8 < motor / start < 2.4, 'not all of a name is there: %s' % names


def wrong(editor, said, name):
    """The problem list: a duplicate name and an undeclared one, each with its place."""
    editor.to_sheet()
    for problem, place in ((said('"%1" is declared twice{, first in line %2}').split('{')[0].replace('%1', '启动'), said('Symbols')),
                           (said('"%1" is not declared{; did you mean %2?}').split('{')[0].replace('%1', '未声明'),
                            said('%s, rung %d, row %d, column %s') % ('主程序', 1, 1, 'B'))):
        _, y, _, _ = editor.place(editor.find(problem, 'label'))
        beside = [editor.place(node)[1] for node in editor.all(place, 'label') if node.name == place]
        assert y in beside, (problem, place, y, beside)
    editor.shot('chinese-problems-' + name)


def below(screen):
    """the lists below the sheets and the status bar show Chinese names and places"""
    said = gettext.NullTranslations().gettext
    editor = Editor(screen, new_file(screen, HELD, '水泵站.rung'))
    listed(editor, said, 'wide')
    editor.finish()
    wrong(Editor(screen, new_file(screen, WRONG, '水泵站.rung')), said, 'wide')


def small(screen):
    """the same in a Chinese, dark, small window"""
    editor = Chinese(screen, new_file(screen, HELD, '水泵站.rung'), ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    said = editor.said.gettext
    listed(editor, said, 'small')
    editor.finish()
    wrong(Chinese(screen, new_file(screen, WRONG, '水泵站.rung'), ADW_DEBUG_COLOR_SCHEME='prefer-dark'), said, 'small')


small.size = '1024x700x24'
main([project, tip, below] + ([small] if os.path.isdir(os.path.join(BUILD, 'locale')) else []))
