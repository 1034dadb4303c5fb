#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""drag - elements and rungs are dragged with the pointer."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402
from screen import pixels, pointer_name  # noqa: E402
from projects import TWO_RUNGS  # noqa: E402


def rung_lines(path):
    with open(path) as file:
        return [line.strip() for line in file if line.startswith(('RUNG "', '  |'))]


def as_before(path):
    """The saved program passes the check and its rungs do the same."""
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStop=1\n') == ['Motor=1', 'Motor=0']
    assert lines(path, '@print Lamp\nStart=1\nStop=1\n') == ['Lamp=1', 'Lamp=0']


def plain(text):
    return ''.join(text.split())


def elements(screen):
    """an element is dragged into another rung, and undo moves it back"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    editor.drag(editor.grid(80, 1), editor.grid(80 + 119, 1))
    until(lambda: any('Rung 2' in name and 'Stop' in name for name in editor.cells()), 'Stop in rung 2')
    editor.shot('drag-element')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStop=1\n') == ['Motor=1', 'Motor=1']
    assert lines(path, '@print Lamp\nStart=1\nStop=1\n') == ['Lamp=1', 'Lamp=0']
    editor.keys('ctrl+z')
    until(lambda: any('Rung 1' in name and 'Stop' in name for name in editor.cells()), 'Stop in rung 1')
    editor.save(path)
    as_before(path)


def rungs(screen):
    """a rung is dragged by its number before another"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    x, y = editor.grid(60, 0)
    editor.drag((x - 85, y + 119), (x - 85, y))
    until(lambda: any('Rung 1' in name and 'Lamp' in name for name in editor.cells()), 'the other order')
    editor.save(path)
    assert rung_lines(path)[0] == 'RUNG "two"', rung_lines(path)
    check(path)
    # The cursor went with it: the next key acts on that rung.
    editor.keys('ctrl+Delete')
    until(lambda: not any('Lamp' in name for name in editor.cells()), 'the rung that was dragged to be gone')
    editor.keys('ctrl+z')
    editor.element('Rung 1', 'Lamp')
    # Lamp now comes before Motor: it follows one scan late.
    assert lines(path, '@print Lamp\nStart=1\n.\nStop=1\n.\n') == ['Lamp=0', 'Lamp=1', 'Lamp=1', 'Lamp=0']


def branch(screen):
    """a branch and a wire by keys: open it, fill it, close it"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Lamp')
    text = editor.save(path)
    assert 'NO Lamp' in text, text
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\nStop=1\n') == ['Motor=1', 'Motor=1', 'Motor=0']
    editor.keys('ctrl+z')
    until(lambda: not any('Rung 1' in name and 'Lamp' in name for name in editor.cells()), 'the branch to go')
    editor.save(path)
    as_before(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def saved(editor, path, good):
    """Saves until the file is so; the drag may not have ended yet."""
    def look():
        editor.keys('ctrl+s')
        return good(rung_lines(path))
    until(look, 'the file to be so')


def wires(screen):
    """wires are drawn and erased by dragging alone: down, across, around; Esc cancels"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    wire = 36 + 46  # below a title
    # From the end of Start down into a new row, then to the right.
    editor.drag(editor.wire_end(wire, 1, -8), editor.wire_end(wire + 84, 3, 4), look='wire-down')
    saved(editor, path, lambda rows: '^' in ''.join(rows))
    assert plain(''.join(rung_lines(path)[1:3])) == '|NOStart|NCStop|---|COILMotor||^|---|---|', rung_lines(path)
    # Up to the wire: a second way around Stop.
    editor.drag(editor.wire_end(wire + 84, 3, -6), editor.wire_end(wire, 3, 5), look='wire-up')
    saved(editor, path, lambda rows: plain(rows[2]).endswith('---^|'))
    editor.says('is short-circuited')
    # Ctrl erases: first the part that leads up, then the rest.
    editor.drag(editor.wire_end(wire, 3, 5), editor.wire_end(wire + 84, 3, 5), key='ctrl', look='wire-erase')
    saved(editor, path, lambda rows: not rows[2].endswith('^|'))
    editor.drag(editor.wire_end(wire + 84, 3, -6), editor.wire_end(wire, 1, 5), key='ctrl')
    saved(editor, path, lambda rows: '^' not in ''.join(rows))
    assert rung_lines(path)[2] == 'RUNG "two"', rung_lines(path)
    as_before(path)


SEAL_IN = TWO_RUNGS.replace('| NO Start | NC Stop | COIL Motor |\n', '| NO Start  | NC Stop | COIL Motor |\n  | NO Motor ^|\n')


def at_node(screen):
    """a drop on the wire where a branch begins goes into that wire; below an element, in parallel"""
    path = new_file(screen, SEAL_IN.replace('NO Motor | COIL Lamp', 'NO Motor | NC Lamp | COIL Lamp'))
    before = rung_lines(path)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 7, 'the sheet')
    wire = 36 + 46
    taken = editor.middle(editor.element('Rung 2, NC', 'Lamp'))
    for by in -4, 0, 4:
        editor.drag(taken, editor.wire_end(wire, 1, by), look='drag-node')
        saved(editor, path, lambda rows: rows[1:3] == ['| NO Start  | NC Lamp | NC Stop | COIL Motor |', '| NO Motor ^|'])
        editor.keys('ctrl+z')
        saved(editor, path, lambda rows: rows == before)
    # There is room below Stop: a branch.
    x, y = editor.wire_end(wire, 2, -49)
    editor.drag(taken, (x, y + 28), look='drag-under')
    saved(editor, path, lambda rows: rows[1:3] == ['| NO Start  | NC Stop  | COIL Motor |', '| NO Motor ^| NC Lamp ^|'])
    editor.keys('ctrl+z')
    saved(editor, path, lambda rows: rows == before)
    # There is none below Start: the drop goes before Start, not to the element below.
    x, y = editor.wire_end(wire, 1, -49)
    editor.drag(taken, (x, y + 28))
    saved(editor, path, lambda rows: plain(rows[1]) == '|NCLamp|NOStart|NCStop|COILMotor|')
    check(path)


def quick(screen):
    """a quick drag whose pointer is seen only at its two ends"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    editor.drag(editor.wire_end(36 + 46, 0, 10), editor.wire_end(36 + 46, 1, 10), steps=1)
    editor.says('This branch is empty')
    saved(editor, path, lambda rows: '^' in ''.join(rows))
    editor.entry('Lamp')
    saved(editor, path, lambda rows: 'NO Lamp ^' in rows[2])
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\nStop=1\n') == ['Motor=1', 'Motor=1', 'Motor=0']


def refused(screen):
    """an impossible wire is refused with a message; Esc cancels a wire"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    before = open(path).read()
    wire = 36 + 46
    # Along an existing wire: nothing to do.
    editor.drag(editor.wire_end(wire, 3), editor.wire_end(wire, 4))
    editor.says('the wire is there already')
    (x0, y0), (x1, y1) = editor.wire_end(wire, 1), editor.wire_end(wire + 84, 3)
    sh('xdotool', 'mousemove', str(x0), str(y0), 'mousedown', '1', 'mousemove', str(x0), str(y0 + 30),
       'sleep', '0.1', 'mousemove', str(x1), str(y1), 'sleep', '0.2', 'key', 'Escape',
       'sleep', '0.1', 'mousemove', str(x1 + 9), str(y1 + 9), 'sleep', '0.1', 'mouseup', '1')
    editor.says('Rung 1 · column')  # after Esc the rest of the drag selects no rungs
    # A drag from a free place still selects.
    editor.drag(editor.grid(wire + 25, 2), editor.grid(wire + 25, 3))
    editor.keys('Insert')
    text = editor.save(path)
    assert plain(text).replace('RUNGRUNG', 'RUNG', 1) == plain(before), text
    editor.entry('Lamp')
    editor.entry('OUT %QX0.2')
    editor.save(path)
    as_before(path)
    assert lines(path, '@print %QX0.2\nStart=1\n.\nStop=1\n.\n') == ['%QX0.2=0', '%QX0.2=1', '%QX0.2=1', '%QX0.2=0']


def seen(editor, name):
    """An item of an open menu; hidden menus have the same items elsewhere."""
    return until(lambda: next((node for node in editor.all(name, 'menu item') if node.box()[2] > 0), None), name)


def by_menu(screen):
    """the context menu draws wires, too"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    editor.click(editor.grid(80, 0), button=3)
    editor.at_rest(seen(editor, 'Wires'))
    editor.keys(*['Down'] * 5)
    until(lambda: seen(editor, 'Wires').has(12), 'the focus on Wires')
    editor.keys('Return')
    editor.at_rest(seen(editor, 'Wire downwards'))
    editor.keys(*['Down'] * 4)
    until(lambda: seen(editor, 'Wire downwards').has(12), 'the focus on it')
    editor.shot('menu-of-wires')
    editor.keys('Return')
    until(lambda: editor.all('row 2 · column A'), 'the cursor below')
    editor.save(path)
    assert plain(rung_lines(path)[2]) == '|^|', rung_lines(path)
    editor.entry('Lamp')
    assert 'NO Lamp ^' in editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\nStop=1\n') == ['Motor=1', 'Motor=1', 'Motor=0']


def rung_of(node):
    return int(node.name.split()[1].rstrip(','))


def far(screen):
    """a drag held at the lower edge scrolls the sheet to a rung out of sight"""
    # Each rung has its own coil, so that one drop does not repeat another.
    more = ''.join('RUNG\n  | NO Motor | COIL %%MX%d.%d |\n' % divmod(number, 8) for number in range(40))
    text = TWO_RUNGS.replace('END_PROGRAM', more + 'END_PROGRAM')
    path = new_file(screen, text)
    editor = Editor(screen, path)
    stop = editor.element('Rung 1,', 'Stop')
    last = max(map(rung_of, editor.all('Rung ', 'table cell')))
    x, y, width, height = editor.place(editor.sheet())
    to, edge = x + 61 + 98 + 49, y + height - 18
    start = editor.middle(stop)
    way = ['mousemove', str(start[0]), str(start[1]), 'mousedown', '1']
    for i in range(1, 13):
        way += ['mousemove', str(start[0] + (to - start[0]) * i // 12), str(start[1] + (edge - start[1]) * i // 12),
                'sleep', '0.03']
    sh('xdotool', *way)

    def scrolled():
        # A hand is never quite still; X drops the last motion of a pointer that is.
        sh('xdotool', 'mousemove_relative', '1', '0', 'sleep', '0.05', 'mousemove_relative', '--', '-1', '0')
        return max(map(rung_of, editor.all('Rung ', 'table cell')), default=0) > last + 4
    until(scrolled, 'the sheet to scroll')
    sh('xdotool', 'mousemove', str(to), str(y + height // 2))
    editor.shot('drag-far')
    # Any rung in the middle of the visible part will do.
    there = sorted({rung_of(node) for node in editor.all('Rung ', 'table cell')} - set(range(last + 1)))
    seen = editor.element('Rung %d,' % there[len(there) // 2], 'Motor')
    _, wire = editor.middle(seen)
    sh('xdotool', 'mousemove', str(to), str(wire - 3), 'sleep', '0.1', 'mousemove', str(to), str(wire), 'sleep', '0.1',
       'mouseup', '1')
    until(lambda: [node for node in editor.all('Stop', 'table cell') if rung_of(node) > last], 'Stop in a far rung')
    saved(editor, path, lambda rows: 'Stop' not in rows[1])
    check(path)
    coil = next(row for row in rung_lines(path)[4:] if 'NC Stop' in row).split()[-2]
    assert lines(path, '@print Motor\nStart=1\nStop=1\n') == ['Motor=1', 'Motor=1']
    assert lines(path, '@print %s\nStart=1\nStop=1\n' % coil) == [coil + '=1', coil + '=0']


ACCENT, ERROR = (0x1a, 0x5f, 0xb4), (0xc0, 0x1c, 0x28)
HEAD, ROW, RUNG = 36, 84, 36 + 84 + 9  # px of a rung with a title: above its row, its row, all


def framed(editor, column):
    """From where to where the frame of the target reaches in a column, px below the top of the sheet; None: there is none."""
    x, y, _, _ = editor.place(editor.sheet())
    high = 3 * RUNG
    edge = pixels(x + 61 + 98 * column + 1, y, 1, high)
    found = [at for at in range(high) if edge[at] == ACCENT]
    return (found[0], found[-1]) if found else None


def aims(screen):
    """an element goes where the frame is drawn, at each height between two rungs and below the last; the sheet stays still"""
    path = new_file(screen, TWO_RUNGS)
    before = rung_lines(path)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    tile = editor.tile('closed while FALSE')
    still = [editor.place(node) for node in editor.elements()]
    seen = set()
    x, top = editor.grid(0, 0)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'End')  # the frame of the cursor is in another column
    for at in list(range(HEAD + 46, RUNG + HEAD + 40, 9)) + [2 * RUNG - 4, 2 * RUNG + 40, 2 * RUNG + 80, 2 * RUNG + 100]:
        frame = []

        def held():
            frame[:] = [framed(editor, 0)]
            return [editor.place(node) for node in editor.elements()] == still
        editor.drag(tile, (x, top + at), ready=held, look='drag-slot' if at == HEAD + 46 + 4 * 9 else None)
        first, last = frame[0] or (-1, -1)
        if first < 0:
            assert HEAD + ROW + 9 + 14 <= at <= RUNG + HEAD or at > 2 * RUNG + ROW, 'no frame at %d' % at
            saved(editor, path, lambda rows: rows == before)
            seen.add('none')
            continue
        assert first <= at <= last + 6, (at, frame)
        rung, how = int(first >= RUNG), 'below' if first % RUNG == HEAD + 46 + 18 else 'beside'
        seen.add((rung, how))
        editor.opened()
        editor.entry('Lamp')
        rows = [plain(row) for row in (editor.save(path), rung_lines(path))[1]]
        own = rows[rows.index('RUNG"two"'):] if rung else rows[:rows.index('RUNG"two"')]
        assert 'NCLamp' in ''.join(own) and ('^' in ''.join(own)) == (how == 'below'), (at, frame, rows)
        editor.keys('ctrl+z', 'ctrl+Home', 'End')
        saved(editor, path, lambda rows: rows == before)
    assert seen == {'none', (0, 'beside'), (0, 'below'), (1, 'beside'), (1, 'below')}, seen


def not_there(screen):
    """a coil dragged onto a contact is refused with the reason while it is held; nothing changes"""
    path = new_file(screen, TWO_RUNGS)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 5, 'the sheet')
    told = 'an output can only stand in the last column'
    x, y = editor.grid(80, 0)
    pointer, marks = [], []
    editor.drag(editor.tile('TRUE while powered'), (x, y), look='drag-refused',
                ready=lambda: editor.all(told, 'label') and (pointer.append(pointer_name()) or marks.append(
                    pixels(x - 49, y - 46, 98, 84).count(ERROR)) or True))
    # The pointer says it: nothing is marked there.
    assert marks[-1] == 0, 'a mark in the colour of errors'
    assert pointer[-1] in ('no-drop', 'not-allowed', 'dnd-none', 'dnd-no-drop'), pointer
    until(lambda: editor.all(told, 'label'), 'the reason, still')
    assert len(editor.cells()) == 5 and not editor.all('\u2022 new')
    as_before(path)


main([elements, rungs, branch, wires, at_node, quick, refused, by_menu, far, aims, not_there])
