#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""languages - the editor in Chinese, German and French, on a project with Chinese names.

A session in each: no accessible name may be English if it has a translation, drawn and typed work is saved, and
a print uses the same language.
"""
import gettext
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, EDITOR, Editor, check, main, new_file, sh, until  # noqa: E402

PROJECT = '''RUNGBOARD 1
PROJECT "水泵站"

VAR
  启动 AT %IX0.0 : BOOL; (* 启动按钮，常开 *)
  停止 AT %IX0.1 : BOOL; (* 停止按钮，常闭 *)
  电机 AT %QX0.0 : BOOL; (* 水泵电机的接触器 *)
END_VAR

PROGRAM 主程序 LD
RUNG "电机的启动和停止"
  | NO 启动 | NO 停止 | COIL 电机 |
RUNG "缺少名称"
  | NO 未声明 | R 电机 |
END_PROGRAM
'''
# Texts that must be visible: project tree, a problem, palette, symbols, an answer.
SEEN = {
    'zh_CN': ['程序', '函数和功能块', '“未声明”没有声明', '常开触点：TRUE 时接通', '所有命令', '初始值', '梯级 1'],
    'de': ['Programme', 'Funktionen, Bausteine', '„未声明“ ist nicht deklariert', 'Schließer: geschlossen bei TRUE',
           'Alle Befehle', 'Anfangswert', 'Strompfad 1'],
    'fr': ['Programmes', 'Fonctions et blocs', '«\u00a0未声明\u00a0» n\'est pas déclaré', 'contact à fermeture\u00a0: fermé à TRUE',
           'Toutes les commandes', 'Valeur initiale', 'Échelon 1'],
}
PRINTED = {'zh_CN': ['程序单元', '读取于', '初始值'], 'de': ['Programmeinheit', 'gelesen in', 'Anfangswert'],
           'fr': ['Unité de programme', 'lu dans', 'Valeur initiale']}


def catalogue(language):
    return gettext.translation('rungboard', os.path.join(BUILD, 'locale'), [language])


class Foreign(Editor):
    """The same, with the texts to look for in the language of the editor."""

    def __init__(self, screen, language, *files, **env):
        self.said = catalogue(language)
        super().__init__(screen, *files, LANGUAGE=language, **env)

    def shown_as(self, text):
        return self.said.gettext(text)

    def names(self):
        return {node.name for node in super().all()}

    def english(self, names):
        """Texts of the editor that stayed English though they have a translation."""
        texts = self.said._catalog
        keys = ['Delete']  # the toolkit names the keys
        return sorted(name for name in names if name and texts.get(name, name) != name and
                      name not in texts.values() and name not in keys)


def session(screen, language):
    path = new_file(screen, PROJECT, '水泵站.rung')
    editor = Foreign(screen, language, path)
    until(lambda: SEEN[language][2] in ''.join(editor.names()), 'the problem')
    names = editor.names()
    editor.shot('language-%s' % language)
    editor.keys('ctrl+alt+s')
    until(lambda: editor.all('Initial value'), 'the symbols')
    names |= editor.names()
    editor.shot('language-%s-symbols' % language)
    editor.list_commands()
    names |= editor.names()
    editor.keys('Escape')
    keys_fit(editor, language)
    choices_fit(editor, language)
    editor.keys('ctrl+Page_Up')
    headings_fit(editor, language)
    editor.click(editor.grid(60, 3))
    editor.lines = {node.path for node in editor.all(role='text')}  # the filter's is new
    editor.keys('F5')
    editor.opened()
    editor.entry('允许')
    until(lambda: any('允许' in name for name in editor.names()), 'the new contact')
    names |= editor.names()
    text = editor.save(path)
    assert 'NO 允许' in text and '允许 AT %IX0.2 : BOOL' in text, text
    everything = '\n'.join(names)
    for wanted in SEEN[language]:
        assert wanted in everything, '"%s" is not seen' % wanted
    left = editor.english(names)
    assert not left, 'still English: %s' % left
    printed(screen, path, language)
    rendered(screen, path, language)


def headings_fit(editor, language):
    """Each heading of the status chart is wide enough for its text."""
    editor.click(editor.grid(60, 0))
    editor.keys('ctrl+alt+w')
    until(lambda: editor.all('New value', 'label'), 'the status chart')
    editor.shot('language-%s-watch' % language)
    labels, nodes = editor.all(role='label'), editor.known()
    cut, seen = [], 0
    for label in labels:
        box = nodes.get(label.parent)
        title = box and nodes.get(box.parent)
        if title and title.name == 'GtkColumnViewTitle':
            (x, _, width, _), (left, _, room, _) = label.box(), title.box()
            seen += 1
            cut += [label.name] if x + width > left + room else []
    assert seen > 6 and not cut, (seen, cut)


def keys_fit(editor, language):
    """The window of all keys is no larger than the screen."""
    until(lambda: len(editor.windows()) == 1, 'one window')
    editor.brought('ctrl+question')
    editor.shot('language-%s-keys' % language)
    for window in editor.windows():
        size = dict(line.split('=') for line in sh('xdotool', 'getwindowgeometry', '--shell', window).split())
        assert int(size['WIDTH']) <= 1024 and int(size['HEIGHT']) <= 700, size
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1, 'it to be closed')


def choices_fit(editor, language):
    """Each choice of the preferences that holds is shown whole beside the words below its name."""
    editor.brought('ctrl+comma')
    editor.shot('language-%s-preferences' % language)
    for text in 'as the desktop', 'green', 'symbol and address', 'IEC: %IX0.0':
        said = editor.shown_as(text)
        boxes = until(lambda: [n.box() for n in editor.all(text, 'label') if n.name == said and n.box()[2] > 0], text)
        # One that is cut has less than a third of a line for each letter.
        assert all(wide >= len(said) * high / 3 for _, _, wide, high in boxes), (said, boxes)
    editor.keys('Escape')
    until(lambda: len(editor.windows()) == 1, 'it to be closed')


def printed(screen, path, language):
    good = new_file(screen, open(path).read().replace('NO 未声明', 'NO 电机'), 'good.rung')
    check(good)
    pdf = os.path.join(screen.home, 'print.pdf')
    subprocess.run([EDITOR, '--render', good, '-o', pdf], check=True, env={**os.environ, 'LANGUAGE': language})
    if not shutil.which('pdftotext'):
        return
    text = subprocess.run(['pdftotext', '-layout', pdf, '-'], capture_output=True, text=True, check=True).stdout
    for wanted in PRINTED[language] + ['启动', '水泵电机的接触器', '水泵站']:
        assert wanted in text, '"%s" is not printed:\n%s' % (wanted, text)
    assert 'Program unit' not in text and 'read in' not in text, text


def rendered(screen, path, language):
    """What --render reports about a file: place, severity and text are all in that language."""
    said = catalogue(language).gettext
    none = os.path.join(screen.home, 'none.rung')
    places = {none: ('', 'LD002', 'cannot read this file'),
              path: (said('rung %d (%d,%d): ') % (2, 1, 1), 'LD301', '"%1" is not declared{; did you mean %2?}')}
    for file, (rung, code, text) in places.items():
        done = subprocess.run([EDITOR, '--render', '--check', file, '-o', os.path.join(screen.home, 'a.svg')],
                              capture_output=True, text=True, env={**os.environ, 'LANGUAGE': language})
        wanted = (' ' + rung + said('%s %s: %s')).replace('%s', said('error'), 1).replace('%s', code, 1).replace('%s', '')
        end = said(text).split('{')[0].split('%1')[-1]
        assert done.returncode and done.stderr.startswith(file + ':') and wanted in done.stderr and end in done.stderr, (wanted, done)
        assert text.split('{')[0].split('%1')[-1] not in done.stderr, done.stderr


def chinese(screen):
    """a session in Chinese"""
    session(screen, 'zh_CN')


def german(screen):
    """a session in German"""
    session(screen, 'de')


def french(screen):
    """a session in French"""
    session(screen, 'fr')


if __name__ == '__main__':
    if os.path.isdir(os.path.join(BUILD, 'locale')):
        for test in chinese, german, french:
            test.size = '1024x700x24'
        main([chinese, german, french])
    print('1..0 # SKIP the languages were not built: no msgfmt')
