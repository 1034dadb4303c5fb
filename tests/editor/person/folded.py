#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""folded - a rung that is wider than the sheet goes on below: keys, pointer, drag, values, search, width and zoom."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, sh, until  # noqa: E402
from screen import pixels, urge  # noqa: E402

NAMES = ['Gate%d' % i for i in range(14)]
PROJECT = '''RUNGBOARD 1

VAR
%s  Motor AT %%QX0.0 : BOOL;
  Lamp AT %%QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "All gates are closed"
  | %s | COIL Motor |
  | NO Motor ^ |
RUNG
  | NO Motor | COIL Lamp |
END_PROGRAM
''' % (''.join('  %s AT %%IX%d.%d : BOOL;\n' % (name, i // 8, i % 8) for i, name in enumerate(NAMES)),
       ' | '.join('NO ' + name for name in NAMES))
COLUMNS = 'ABCDEFGHIJKLMN'
ACCENT = (0x1a, 0x5f, 0xb4)


def opened(screen, **env):
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path, **env)
    editor.to_sheet()
    editor.keys('alt+z')
    editor.says('Rungs that are wider than the sheet are folded')
    inside(editor)
    return editor, path


def gate(editor, name):
    """The contact of a gate; Gate1 is not Gate10."""
    def look():
        return [node for node in editor.elements() if re.match('Rung 1, N[OC], .*\\b%s\\b' % name, node.name)]
    return until(look, name)[0]


def places(editor):
    """Where the gates and the coil behind them are."""
    return [editor.place(gate(editor, name)) for name in NAMES] + [editor.place(editor.element('COIL', 'Motor'))]


def tops(editor):
    """The lines, as the upper edges of their cells."""
    return sorted({y for _, y, _, _ in places(editor)})


def inside(editor):
    """Waits until each element is between the edges of the sheet, in lines from left to right."""
    def look():
        left, _, width, _ = editor.place(editor.sheet())
        boxes = places(editor)
        return all(left <= x and x + wide <= left + width for x, _, wide, _ in boxes) and \
            all(y1 > y0 or (y1 == y0 and x1 >= x0 + wide - 1) for (x0, y0, wide, _), (x1, y1, _, _) in zip(boxes, boxes[1:]))
    until(look, 'all elements on the sheet, in lines')


def moves(screen):
    """the cursor goes across a fold by Left and Right, and to the line below by Down; a click meets what is shown"""
    editor, _ = opened(screen)
    assert len(tops(editor)) >= 2, tops(editor)
    editor.keys('ctrl+Home')
    for column in COLUMNS:
        editor.says('Rung 1 · column ' + column)
        editor.keys('Right')
    editor.says('Rung 1 · column O')
    editor.keys('Left', 'Left')
    editor.says('Rung 1 · column M')
    boxes = places(editor)
    second = next(i for i, box in enumerate(boxes) if box[1] > boxes[0][1])
    editor.keys('Home')
    editor.says('Rung 1 · column A')
    editor.keys('Down')
    editor.says('Rung 1 · row 2 · column A')  # the branch
    editor.keys('Down')
    editor.says('Rung 1 · column ' + COLUMNS[second])
    editor.keys('Up')
    editor.says('Rung 1 · row 2 · column A')
    editor.keys('End')
    editor.keys('ctrl+Home', 'Right', 'Right', 'Down', 'Down')
    nearest = min(range(second, len(NAMES)), key=lambda i: (boxes[i][1] > boxes[second][1], abs(boxes[i][0] - boxes[2][0])))
    editor.says('Rung 1 · column ' + COLUMNS[nearest])
    editor.shot('folded')
    for number, name in reversed(list(enumerate(NAMES))):
        until(lambda: gate(editor, name), name)
        x, y, width, height = editor.place(gate(editor, name))
        _, top, _, high = editor.place(editor.sheet())
        if top <= y and y + height <= top + high:
            editor.click(editor.beside(gate(editor, name)))
            editor.says('Rung 1 · column ' + COLUMNS[number])


def edits(screen):
    """an element is typed at a fold, one is dropped on a later line, one is dragged from line to line; Undo"""
    editor, path = opened(screen)
    boxes = places(editor)
    second = next(i for i, box in enumerate(boxes) if box[1] > boxes[0][1])
    editor.click(editor.beside(editor.element('Rung 1, NO', NAMES[second])))
    editor.says('Rung 1 · column ' + COLUMNS[second])
    editor.keys('slash')
    editor.element('Rung 1, NC', NAMES[second])
    x, y = editor.middle(editor.element('Rung 1, NO', NAMES[second + 1]))
    editor.drag(editor.tile('closed while FALSE'), (x + boxes[0][2] // 2, y))  # on the wire behind it
    editor.entry('Lamp')
    editor.element('Rung 1, NC', 'Lamp')
    inside(editor)
    saved = ' '.join(editor.save(path).split())
    assert 'NC %s | NO %s | NC Lamp | NO %s' % tuple(NAMES[second:second + 3]) in saved, saved
    editor.keys('ctrl+z')
    until(lambda: not [node for node in editor.elements() if 'NC, Lamp' in node.name], 'the rung without it')
    # From the second line to the wire behind the first element.
    x, y = editor.middle(editor.element('Rung 1, NO', NAMES[0]))
    editor.drag(editor.middle(editor.element('Rung 1, NO', NAMES[second + 1])), (x + boxes[0][2] // 2 + 8, y))
    until(lambda: editor.place(gate(editor, NAMES[second + 1]))[1] == editor.place(gate(editor, NAMES[0]))[1], 'the moved element')
    editor.shot('folded-moved')
    saved = ' '.join(editor.save(path).split())
    assert 'NO %s | NO %s | NO %s' % (NAMES[0], NAMES[second + 1], NAMES[1]) in saved, saved
    check(path)


def beneath(screen):
    """in a later line, an element that is dropped into the frame below a contact comes in parallel to it; no line moves before"""
    editor, path = opened(screen)
    boxes = places(editor)
    before = editor.save(path)
    lines = sorted({y for _, y, _, _ in boxes})
    tried = [next(i for i in reversed(range(len(NAMES))) if boxes[i][1] == y) for y in lines[1:] if y != boxes[-1][1]]
    tried.append(len(NAMES) - 1)  # in the last line, with the coil
    for number in tried:
        editor.keys('ctrl+Home')
        x, y = editor.middle(gate(editor, NAMES[number]))
        still = places(editor)
        accent = []

        def held():
            accent[:] = [pixels(x - 49, y + 18, 98, 1).count(ACCENT)]
            return accent[0] >= 20 and places(editor) == still
        editor.drag(editor.tile('closed while FALSE'), (x, y + 24), ready=held, look='folded-beneath-%d' % number)
        editor.opened()
        editor.entry('Lamp')
        saved = [''.join(line.split()) for line in editor.save(path).splitlines()]
        assert any('NCLamp^' in line and 'NO' + NAMES[number] not in line for line in saved), saved
        editor.keys('ctrl+z')
        assert editor.save(path) == before


def drawn(points):
    """Which of these points of the screen are in the wire that is being drawn: 3 px wide, in the colour of the accent."""
    return [any(color == ACCENT for color in pixels(x - 1, y - 1, 3, 3)) for x, y in points]


def wires(screen):
    """a wire is seen wholly while it is drawn: within a later line, and across a fold; the line below the pointer stays"""
    editor, path = opened(screen)
    before = editor.save(path)  # as this program writes it
    boxes = places(editor)
    wire = [(x + wide // 2, y + 46) for x, y, wide, _ in boxes]
    second = next(i for i, box in enumerate(boxes) if box[1] > boxes[0][1])
    third = next(i for i, box in enumerate(boxes) if box[1] > boxes[second][1])
    for way_of, first, last in (('within', second + 1, second + 3), ('across', third - 3, third)):
        x0, y0, x1 = boxes[first][0] - 1, wire[first][1], boxes[last][0] + boxes[last][2]
        grown = 0 if boxes[first][1] == boxes[last][1] else 2 * 84  # all rows, and one more
        to = (x1, boxes[last][1] + grown + 84 + 46)  # the new row of the line
        sh('xdotool', 'mousemove', str(x0), str(y0), 'sleep', '0.2', 'mousedown', '1', 'mousemove', str(x0), str(y0 + 9), 'sleep', '0.2',
           'mousemove', str(x0), str(y0 + 30), 'sleep', '0.2')
        assert editor.place(gate(editor, NAMES[first]))[1] == boxes[first][1], 'the line moved below the pointer'
        way = [(x0, y0 + 20), (x0, y0 + 60), (x0 + 40, y0 + 84)]
        if boxes[first][1] == boxes[last][1]:
            way += [((x0 + x1) // 2, y0 + 84), (x1 - 20, y0 + 84)]
        else:  # on to the fold, and from it
            last_of = max(i for i in range(len(NAMES)) if boxes[i][1] == boxes[first][1])
            right = boxes[last_of][0] + boxes[last_of][2]
            way += [(right - 10, y0 + 84), (right + 5, y0 + 84), (boxes[third][0] - 8, to[1]), (boxes[third][0] + 20, to[1]), (x1 - 20, to[1])]

        def whole():
            sh('xdotool', 'mousemove', str(to[0] - 4), str(to[1]), 'sleep', '0.05', 'mousemove', str(to[0]), str(to[1]), 'sleep', '0.1')
            return all(drawn(way))
        until(whole, 'the whole wire ' + way_of)
        editor.shot('folded-wire-' + way_of)
        sh('xdotool', 'mouseup', '1')
        assert editor.save(path).count('^') == 2
        editor.keys('ctrl+z')
        assert editor.save(path) == before


def line_end(screen):
    """a wire that begins at the end of a line is drawn there, not where the next line begins"""
    editor, path = opened(screen)
    boxes = places(editor)
    second = next(i for i, box in enumerate(boxes) if box[1] > boxes[0][1])
    last = max(i for i in range(len(NAMES)) if boxes[i][1] == boxes[second][1])
    right, y0 = boxes[last][0] + boxes[last][2], boxes[last][1] + 46
    x1 = boxes[last - 1][0]
    sh('xdotool', 'mousemove', str(right - 4), str(y0), 'sleep', '0.2', 'mousedown', '1', 'mousemove', str(right - 4), str(y0 + 20),
       'sleep', '0.2', 'mousemove', str(right - 4), str(y0 + 60), 'sleep', '0.2')

    def whole():
        sh('xdotool', 'mousemove', str(x1 + 3), str(y0 + 80), 'sleep', '0.05', 'mousemove', str(x1), str(y0 + 84), 'sleep', '0.1')
        return all(drawn([(right, y0 + 20), (right, y0 + 60), (right - 40, y0 + 84), (x1 + 20, y0 + 84)]))
    until(whole, 'the whole wire')
    editor.shot('folded-wire-end')
    sh('xdotool', 'mouseup', '1')
    cells = [line for line in editor.save(path).splitlines() if line.startswith('  |')][1].split('|')[1:-1]
    assert cells[-1].split() == ['---', '^'] and len(cells) == last + 1, cells


def runs(screen):
    """while simulating, a click in a later line toggles its contact, power goes on there, hits of a search are shown"""
    editor, _ = opened(screen)
    editor.keys('ctrl+m')
    editor.find('Input Gate0, %IX0.0', 'check box')
    inside(editor)
    editor.keys('ctrl+Home')
    for name in NAMES:  # all lines are in sight
        editor.click(editor.middle(gate(editor, name)))
        editor.element('Rung 1, NO', name, ', closed')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.shot('folded-runs')
    editor.keys('ctrl+f')
    editor.type('Gate12')
    urge(lambda: editor.all('Rung 1 · column M'), lambda: editor.keys('Return'), 'the hit in the last line', wait=5)
    left, top, width, height = editor.place(editor.sheet())
    x, y, wide, high = editor.place(gate(editor, 'Gate12'))
    assert left <= x and x + wide <= left + width and top <= y and y + high <= top + height, (x, y)
    editor.shot('folded-found')


def follows(screen):
    """the lines follow the width of the sheet and the zoom; another key shows one line again; the choice is kept"""
    folder = os.path.join(screen.home, '.config')
    os.makedirs(folder, exist_ok=True)
    kept = dict(GSETTINGS_BACKEND='keyfile', XDG_CONFIG_HOME=folder)
    editor, path = opened(screen, **kept)
    usual = len(tops(editor))
    editor.keys('ctrl+minus', 'ctrl+minus', 'ctrl+minus', 'ctrl+minus')
    until(lambda: len(tops(editor)) < usual, 'fewer lines in smaller letters')
    inside(editor)
    editor.keys('ctrl+0', 'ctrl+plus', 'ctrl+plus')
    until(lambda: len(tops(editor)) > usual, 'more lines in larger letters')
    inside(editor)
    editor.keys('ctrl+0')
    until(lambda: len(tops(editor)) == usual, 'the lines as before')
    editor.keys('F4')  # without the left panel
    until(lambda: not editor.all('Find an element'), 'the left panel to be gone')
    inside(editor)
    wide = places(editor)
    assert sum(y == wide[0][1] for _, y, _, _ in wide) > 6, wide
    editor.shot('folded-wide')
    editor.finish()
    editor = Editor(screen, path, **kept)
    editor.to_sheet()
    inside(editor)
    editor.keys('alt+z')
    editor.says('Rungs have one line, however wide they are')
    until(lambda: len(tops(editor)) == 1, 'one line')


moves.size = edits.size = beneath.size = runs.size = follows.size = '1024x700x24'
wires.size = line_end.size = '1024x900x24'
moves.quick = 'editor-gtk/ladder'
main([moves, edits, beneath, wires, line_end, runs, follows])
