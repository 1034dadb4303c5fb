#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""looks - the window is used in the dark, with high contrast, on a small and on a very large screen."""
import gettext
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, ROOT, Editor, check, lines, main, new_file, sh, until  # noqa: E402
from screen import urge  # noqa: E402

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
    """a project with mistakes: they are listed, and a key goes to the next one"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.says('1 error')
    editor.keys('ctrl+period')
    until(lambda: editor.all('Rung 3'), 'the rung of the mistake')
    editor.shot('looks-light')


def large_letters(screen):
    """letters 1.5 times as large, 1024 px wide: the window fits, no name in the panel of the simulation is cut"""
    sh('xprop', '-root', '-f', 'RESOURCE_MANAGER', '8s', '-set', 'RESOURCE_MANAGER', 'Xft.dpi:\t144\n')
    path = os.path.join(screen.home, 'ladders', 'garage-door.rung')
    shutil.copytree(os.path.join(ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    names = 'ButtonDown', 'DownFree', 'MotorDown'
    labels = until(lambda: [[n for n in editor.all(name, 'label') if n.name == name and n.box()[2] > 0] for name in names],
                   'the names')
    editor.shot('looks-letters')
    for name, found in zip(names, labels):
        # A label that is cut has less than a third of a line for each letter.
        assert found and found[0].box()[2] >= len(name) * found[0].box()[3] / 3, (name, [n.box() for n in found])
    wide = editor.all(role='frame')[0].box()[2]
    assert wide <= 1024, 'the window is %d px wide' % wide


class French(Editor):
    """The same, with the texts to look for in French."""

    def __init__(self, screen, *files, **env):
        self.said = gettext.translation('rungboard', os.path.join(BUILD, 'locale'), ['fr'])
        super().__init__(screen, *files, LANGUAGE='fr', **env)

    def shown_as(self, text):
        return self.said.gettext(text)


def french(screen):
    """1024 px in French, simulating: the tab at the edge of the hidden side answers, messages of alarms and long names have room"""
    shutil.copytree(os.path.join(ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
    editor = French(screen, os.path.join(screen.home, 'ladders', 'cement-plant', 'cement-plant.rung'))
    editor.says('Idle')
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    until(lambda: not editor.all('Find an element'), 'the left side to be folded')
    long, short = (until(lambda: [n for n in editor.all(name, 'label') if n.box()[3] > 0], name)[0].box()
                   for name in ('DischargedButton', 'MixButton'))
    assert long[0] < short[0], 'the long name stands above its address: %s, %s' % (long, short)
    editor.tab(editor.shown_as('Status chart'))  # it is where the edge of the left side was
    editor.find('Write all new values', 'push button')

    def headings():
        found = [[n.box()[0] for n in editor.all(name, 'label') if n.name == editor.shown_as(name) and n.box()[2] > 0]
                 for name in ('Came', 'Message', 'Block')]
        return all(found) and [places[0] for places in found]

    # The row of tabs may still move while it is clicked.
    came, message, _ = urge(headings, lambda: editor.tab(editor.shown_as('Alarms')), 'the headings')
    until(lambda: headings()[2] - headings()[1] >= 260 > message - came, 'room for the message')
    editor.shot('looks-french')


def last_tab(screen):
    """a panel beside the sheets takes room from the tabs: the tab in front stays whole, with its close button"""
    editor = Editor(screen, new_file(screen, GOOD))
    editor.to_sheet()
    for page in 'Tasks', 'Data types', 'Print preview', 'State of the board', 'Address map':
        editor.command(page)
        until(lambda: len(editor.all(role='page tab')) > 0, page)
    editor.keys('ctrl+m')
    editor.says('SIMULATION')
    panel = until(lambda: [n for n in editor.all('Filter the variables') if n.box()[2] > 0], 'the panel')[0]
    until(lambda: max(n.box()[0] + n.box()[2] for n in editor.all('Close Tab')) <= panel.box()[0],
          'the last tab to be in sight')
    editor.shot('looks-tab')


def title(screen):
    """1024 px in French: in whole seconds of a simulation, too, the title has tenths, so it does not jump"""
    path = new_file(screen, GOOD.replace('END_PROGRAM\n', '''END_PROGRAM

CONFIGURATION Plant
  RESOURCE Station ON PLC
    TASK Slow(INTERVAL := T#1s, PRIORITY := 1);
    PROGRAM One WITH Slow : Main;
  END_RESOURCE
END_CONFIGURATION
'''))
    editor = French(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+m')

    def stands():
        found = [node for node in editor.all(role='label') if re.search(r' · \w+ [1-9]\d* · \d+(\.\d)? s$', node.name)]
        return found and found[0]
    label = until(stands, 'whole seconds in the title')
    editor.shot('looks-title')
    assert re.search(r' · \d+\.0 s$', label.name), label.name


def small(screen):
    """a rung drawn on a screen of 1024x700"""
    editor = draw(screen, 'looks-small')
    _, _, width, height = editor.place(editor.sheet())
    assert width >= 600 and height >= 250, 'the sheet is %d x %d' % (width, height)
    editor.keys('ctrl+Home', 'ctrl+m')
    editor.find('Input Start, %IX0.0', 'check box')
    until(lambda: editor.place(editor.sheet())[2] >= 700, 'room for the rungs')
    left, top, width, height = editor.place(editor.sheet())
    for what in ('Rung 1, COIL', 'Motor'), ('Rung 2, COIL', 'Lamp'), ('Rung 3, COIL', 'Idle'):
        x, y, wide, high = editor.place(editor.element(*what))
        assert left < x and x + wide <= left + width and top < y and y + high <= top + height, (what, x, y, wide, high)
    editor.shot('looks-small-simulated')
    editor.keys('ctrl+m')
    editor.find('Find an element')


def narrow(screen):
    """1024x700, editing: a rung with contacts, a timer and a counter is no wider than the sheet; a click meets its cells"""
    path = new_file(screen, GOOD.replace('COIL Lamp |', 'CTU Parts R:=Stop PV:=10 | NC Stop | NC Start | COIL Lamp |')
                    .replace('  Delay : TON;', '  Delay : TON;\n  Parts : CTU;'))
    editor = Editor(screen, path)
    editor.to_sheet()
    left, _, width, _ = editor.place(editor.sheet())
    for what in ('Rung 1, COIL', 'Motor'), ('Rung 2, COIL', 'Lamp'):
        x, _, wide, _ = editor.place(editor.element(*what))
        assert left < x and x + wide + 24 <= left + width, (what, x, wide, left, width)
    for column, *what in ('E', 'Rung 2, NC', 'Start'), ('C', 'Rung 2, CTU', 'Parts'), ('F', 'Rung 2, COIL', 'Lamp'):
        editor.click(editor.element(*what))
        editor.says('Rung 2 · column ' + column)
    editor.shot('looks-narrow')


def edge(screen):
    """1024x700, editing: the coil of a rung that is too wide stays at the edge of the sheet; it is edited there"""
    path = new_file(screen, GOOD.replace('COIL Lamp |', '| '.join(['NO Start '] * 12) + '| COIL Lamp |'))
    editor = Editor(screen, path)
    editor.to_sheet()
    left, _, width, _ = editor.place(editor.sheet())
    for what in ('Rung 1, COIL', 'Motor'), ('Rung 2, COIL', 'Lamp'):
        x, _, wide, _ = editor.place(editor.element(*what))
        assert left < x and x + wide <= left + width, (what, x, wide, left, width)
    editor.click(editor.element('Rung 1, COIL', 'Motor'))
    editor.keys('slash')
    editor.element('Rung 1, COILNOT', 'Motor')
    editor.shot('looks-edge')
    assert 'COILNOT Motor' in editor.save(path)
    editor.keys('ctrl+Home', *['Right'] * 8)
    editor.says('Rung 1 · column I')
    editor.element('Rung 1, COILNOT', 'Motor')
    editor.keys('ctrl+Home')
    check(path)


WIDE = '\n'.join('RUNG\n  | %s | COIL Out%d |' % (' | '.join(elements), number) for number, elements in enumerate((
    ['NO A%d' % i for i in range(9)],
    ['NC AVeryLongNameOfAContact%d' % i for i in range(6)],
    ['NO A0', 'NO AVeryLongNameOfAContact1', 'TON Delay PT:=T#5s', 'NO A3', '[ Count > 500 ]', 'NO A5', 'NO A6'],
    ['[ Count > %d ]' % (10 ** i) for i in range(7)],
)))


def beside(screen):
    """a small window while simulating: the pinned coil covers no element at the cursor, and cuts none"""
    names = ['A%d' % i for i in range(9)] + ['AVeryLongNameOfAContact%d' % i for i in range(6)]
    path = new_file(screen, 'RUNGBOARD 1\n\nVAR\n%s  Count : DINT;\n%sEND_VAR\n\nPROGRAM Main LD\nVAR\n  Delay : TON;\nEND_VAR\n%s\nEND_PROGRAM\n' % (
        ''.join('  %s AT %%IX%d.%d : BOOL;\n' % (name, i // 8, i % 8) for i, name in enumerate(names)),
        ''.join('  Out%d AT %%QX0.%d : BOOL;\n' % (i, i) for i in range(4)), WIDE))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+m')
    editor.find('Filter the variables')
    until(lambda: not editor.all('Find an element'), 'the left side to be folded')
    editor.keys('ctrl+Home')
    for rung, count in enumerate((9, 6, 7, 7)):
        editor.keys('Home')
        for column in range(count):
            editor.says('Rung %d · column %s' % (rung + 1, 'ABCDEFGHI'[column]))
            coil = editor.place(editor.element('Rung %d, COIL' % (rung + 1)))[0]
            x, _, width, _ = editor.place(editor.sheet())
            here = until(lambda: [node for node in editor.all('Rung %d, ' % (rung + 1)) if node.has(23)], 'the cell')[0]
            until(lambda: editor.place(here)[0] >= x and editor.place(here)[0] + editor.place(here)[2] <=
                  editor.place(editor.element('Rung %d, COIL' % (rung + 1)))[0] + 1,
                  'the cell at the cursor beside the coil: rung %d, column %d, %s, %d' % (rung + 1, column, editor.place(here), coil))
            editor.keys('Right')
        editor.shot('looks-beside-%d' % rung)
        editor.keys('Home', 'Down')


def columns(screen):
    """1024x700: the symbols have no room for all columns; the menu brings one back, by keys alone"""
    path = new_file(screen, GOOD)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.command('Symbols')
    editor.find('Columns')
    assert not editor.all('Motor, Constant')
    editor.shot('looks-columns')
    editor.step_to(lambda: any(node.has(12) for node in editor.all('Columns')), 'Tab', 'the menu')
    editor.keys('Return')
    editor.find('Constant', 'menu item')
    editor.shot('looks-columns-menu')
    editor.step_to(lambda: editor.find('Constant', 'menu item').has(12), 'Down', 'the column')
    editor.keys('Return')
    until(lambda: editor.all('Lamp, Constant', 'check box'), 'the column Constant')
    editor.shot('looks-columns-back')


def symbols(screen):
    """1024x700, simulating: the buttons for the chosen symbol do not make the window wider than the screen"""
    path = os.path.join(screen.home, 'ladders', 'garage-door.rung')
    shutil.copytree(os.path.join(ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+m')
    editor.find('Filter the variables')
    editor.command('Symbols')
    editor.click(until(lambda: [n for n in editor.all('ButtonDown') if n.box()[0] < 200 and n.box()[2] > 0], 'a symbol')[0])
    access = until(lambda: [n for n in editor.all('Access for operators') if n.box()[2] > 0], 'the buttons for it')[0]
    editor.place(access)
    editor.shot('looks-symbols')
    for node in editor.walk():
        x, _, wide, _ = node.box() if node.widget else (0, 0, 0, 0)
        assert x + wide <= 1024, (node.name, x, wide)


def high(screen):
    """high contrast in the dark: the sheet is black, also outside of rungs"""
    editor = draw(screen, 'looks-high', ADW_DEBUG_COLOR_SCHEME='prefer-dark', ADW_DEBUG_HIGH_CONTRAST='1')
    left, top, width, height = editor.place(editor.sheet())
    for x in left + 6, left + width - 60:
        ground = subprocess.run(['import', '-window', 'root', '-crop', '20x30+%d+%d' % (x, top + height - 40),
                                 '-depth', '8', 'rgb:-'], capture_output=True, check=True).stdout
        # The line below a rung is #8b8b92.
        assert set(ground) <= {0, 0x8b, 0x92} and ground.count(0) > 1500, set(ground)


def fills(editor, width, height):
    """Waits until the window fills the screen and its parts are at their places."""
    def inside():
        edge = editor.scale  # the window manager may add a frame
        places = [node.box() for node in editor.walk() if node.widget]
        return all(x >= -edge and y >= -edge and (x + w - edge) * editor.scale <= width and
                   (y + h - edge) * editor.scale <= height for x, y, w, h in places if w > 0)
    frame = editor.all(role='frame')[0]
    until(lambda: width - 24 <= frame.box()[2] * editor.scale <= width and
          height - 24 <= frame.box()[3] * editor.scale <= height, 'the window to fill the screen')
    until(inside, 'all parts to be inside')
    left, top, wide, high = editor.place(editor.sheet())
    search_x, _, search_wide, _ = editor.place(editor.find('Find an element'))
    _, tabs_y, _, _ = editor.place(editor.find('Problems', 'page tab'))
    _, state_y, _, state_high = editor.place(editor.find('no problems', 'label'))
    assert search_x + search_wide <= left and left < 600 * editor.scale, 'the palette ends at %d' % left
    assert top + high <= tabs_y and top < 200 * editor.scale, 'the sheet ends at %d' % (top + high)
    assert height - 60 * editor.scale <= state_y and state_y + state_high <= height, 'the state is at %d' % state_y
    return left + wide


def large(screen, name='looks-4k', **env):
    """a screen of 3840x2160: the window fills it, everything is inside and the pointer meets it"""
    editor = draw(screen, name + '-window', **env)
    editor.keys('F11', 'ctrl+Home')
    assert fills(editor, 3840, 2160) >= 3800, 'the sheet does not reach the right side'
    editor.click(editor.tile('closed while FALSE'))
    editor.opened()
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('ctrl+r')
    switch = editor.find('Input Start, %IX0.0', 'check box')
    right = fills(editor, 3840, 2160)
    x, _, width, _ = editor.place(switch)
    assert right <= x and x + width <= 3840, 'the switch is at %d to %d' % (x, x + width)
    editor.click(switch)
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.shot(name)


def sharp(screen):
    """the same with two pixels for one"""
    large(screen, 'looks-4k-sharp', GDK_SCALE='2')


small.size = title.size = narrow.size = edge.size = beside.size = columns.size = large_letters.size = last_tab.size = symbols.size = french.size = '1024x700x24'
large.size = sharp.size = '3840x2160x24'
light.quick = 'editor-gtk/draw'
main([light, dark, high, small, narrow, edge, beside, columns, symbols, last_tab, title, french, large_letters, large, sharp])
