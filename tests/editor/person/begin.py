#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""begin - the welcome page, the palette's search and families, and tables of symbols in files."""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import LADDER, ROOT, Editor, check, main, new_file, sh, until  # noqa: E402
from outcome import drafts  # noqa: E402

CLASSIC = os.path.join(ROOT, 'tests', 'classic', 'projects', 'linuxcnc.clp')
PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL; (* the green one *)
  Lamp  AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Lamp"
  | NO Start | COIL Lamp |
END_PROGRAM
'''


def sample(screen):
    """a sample opens as a copy without a file; once saved it is the first of the recent files"""
    editor = Editor(screen)
    editor.shot('begin-welcome')
    editor.click(editor.find('board-44b0x.rung', 'label'))
    first = editor.element('Rung 1, ').name
    assert editor.all('not saved yet'), [node.name for node in editor.all(role='label')]
    path = os.path.join(screen.home, 'mine.rung')
    editor.give_path(path, 'ctrl+s')
    until(lambda: os.path.exists(path), 'the file')
    check(path)
    editor.says('mine')
    editor.finish()
    again = Editor(screen)
    again.click(again.find(path, 'label'))
    again.says('mine')
    again.element(first)


def cards(screen):
    """each sample is a card with its drawing, its title and a line; no problem is shown; a chart is begun from here, too"""
    editor = Editor(screen)
    editor.says('no problems')
    names = sorted([name for name in os.listdir(os.path.join(ROOT, 'ladders')) if name.endswith('.rung') and '.plant' not in name] +
                   ['cement-plant.rung', 'boiler-room.rung'])
    assert sorted(node.name for node in editor.all('.rung', 'label')) == names
    editor.find('Goods lift. A goods lift for three floors')
    editor.find('Packing bottles into boxes, S7-200 style: all memory by its address. Counts bottles into boxes')
    editor.find('weigh-sorter. Parcels are weighed on a moving belt and pushed into three boxes')
    picture = editor.find('44B0X board', 'picture')
    x, y, width, height = editor.place(picture)

    def drawn():
        out = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '%dx%d+%d+%d' % (width, height, x, y), 'rgb:-'],
                             capture_output=True).stdout
        return len(set(out)) > 40
    until(drawn, 'the drawing of a sample')
    editor.shot('begin-cards')
    editor.click(editor.find('New project with a chart', 'label'))
    editor.find('Step Start, initial')
    until(lambda: not editor.all('Samples, opened as copies'), 'the page to be gone')


def proposes(editor):
    """Waits until the name of a new file is proposed: at first that of the sample."""
    before = editor.windows()
    editor.brought('ctrl+s')
    until(lambda: editor.focused() and editor.focused().text() == 'conveyor.rung', 'the name of the sample')
    editor.keys('Escape')
    until(lambda: editor.windows() == before, 'the end of the dialog')


def in_sight(editor, name):
    """A card of the welcome page; the wheel brings it into sight."""
    def look():
        card = editor.find(name, 'label')
        below = editor.centre(card)[1] - 850
        if below < 0:
            return card
        sh('xdotool', 'mousemove', '800', '400', 'click', '--repeat', str(1 + below // 100), '--delay', '20', '5')
        return None
    return until(look, '%s in sight' % name)


def folder(screen):
    """a sample that is a folder of .st files opens as one project, with its scenarios"""
    path = os.path.join(screen.home, 'mine.rung')
    editor = Editor(screen)
    editor.click(in_sight(editor, 'shift-report'))
    editor.find('not saved yet')
    editor.keys('ctrl+F5')
    editor.find('shift-report.scn', 'label')
    editor.find(' passed', 'label')
    editor.shot('begin-folder')
    editor.give_path(path, 'ctrl+s')
    editor.find('Saved, together with the files of the sample: mine.scn, mine.io', 'label')
    sh(LADDER, 'test', path, check=True)
    sh(LADDER, 'check', '--io', path.replace('.rung', '.io'), path, check=True)
    editor.find('mine.io', 'label')  # in the tree
    editor.finish()


PARTS = 'alarms.rung', 'blocks.rung', 'hopper.rung', 'interlocks.rung', 'mixer.rung', 'signals.rung', 'weighing.rung'


def parts(screen):
    """a sample of several files is whole as a copy; saving it brings the files that it includes, and its I/O map; none is replaced"""
    for there in False, True:
        target = os.path.join(screen.home, 'parts-%d' % there)
        path = os.path.join(target, 'mine.rung')
        os.mkdir(target)
        if there:
            with open(os.path.join(target, 'mixer.rung'), 'w') as file:
                file.write('precious')
        editor = Editor(screen)
        editor.click(in_sight(editor, 'cement-plant.rung'))
        editor.find('not saved yet')
        editor.says('no problems')
        editor.find('Weighing', 'label')
        editor.shot('begin-parts-%d' % there)
        if there:  # the copy runs before it is saved
            editor.keys('ctrl+m')
            editor.says('SIMULATION')
            editor.keys('ctrl+m')
            editor.says('EDIT')
        editor.give_path(path, 'ctrl+s')
        editor.find('Saved, together with the files of the sample: ', 'label')
        assert sorted(os.listdir(target)) == sorted([*PARTS, 'mine.rung', 'mine.plant.rung', 'mine.scn', 'mine.io']), os.listdir(target)
        assert read(os.path.join(target, 'mine.io')) == read(os.path.join(ROOT, 'ladders', 'cement-plant', 'cement-plant.io'))
        if there:
            editor.find('because they already exist: mixer.rung', 'label')
            assert read(os.path.join(target, 'mixer.rung')) == 'precious'
        else:
            editor.says('no problems')
            assert all(read(os.path.join(target, name)) == read(os.path.join(ROOT, 'ladders', 'cement-plant', name)) for name in PARTS)
            sh(LADDER, 'check', path, check=True)
            sh(LADDER, 'test', path, check=True)
        editor.finish()


def belongings(screen):
    """saving the copy of a sample also saves its plant and scenarios under the copy's name; no file is replaced"""
    names = 'mine.rung', 'mine.plant.rung', 'mine.scn'
    for there in False, True:
        path, plant, scenarios = [os.path.join(screen.home, 'copy-%d' % there, name) for name in names]
        os.mkdir(os.path.dirname(path))
        editor = Editor(screen)
        editor.click(in_sight(editor, 'conveyor.rung'))
        editor.element('Rung 1, ')
        if there:
            with open(scenarios, 'w') as file:
                file.write('# precious\n')
        else:
            # The scenarios run before the copy is saved.
            editor.keys('ctrl+F5')
            editor.find('conveyor.scn', 'label')
            editor.find(' passed', 'label')
            editor.shot('begin-belongings')
        proposes(editor)
        editor.give_path(path, 'ctrl+s')
        told = 'Saved, together with the files of the sample: '
        editor.find(told + ('mine.plant.rung' if there else 'mine.plant.rung, mine.scn'), 'label')
        assert sorted(os.listdir(os.path.dirname(path))) == sorted(names)
        assert read(plant) == read(os.path.join(ROOT, 'ladders', 'conveyor.plant.rung'))
        if there:
            editor.find('because they already exist: mine.scn', 'label')
            assert read(scenarios) == '# precious\n'
        else:
            assert 'plant "mine.plant.rung"' in read(scenarios)
            sh(LADDER, 'test', path, check=True)
            editor.find('mine.scn', 'label')  # also in the tree
            editor.keys('ctrl+F5')
            until(lambda: len(editor.all('mine.scn', 'label')) > 2, 'the scenarios of the copy')
            editor.find(' passed', 'label')
            # Saved under another name it is no longer a copy of the sample.
            other = os.path.join(screen.home, 'other.rung')
            editor.give_path(other, 'ctrl+shift+s')
            until(lambda: os.path.exists(other), 'the other file')
            assert not os.path.exists(other.replace('.rung', '.scn'))
        editor.logs('system', told)
        editor.shot('begin-belongings-%d' % there)
        editor.finish()


def killed(screen):
    """kill -9 with a changed sample: the next start restores the copy, and saving it saves plant and scenarios"""
    path = os.path.join(screen.home, 'mine.rung')
    editor = Editor(screen)
    editor.click(in_sight(editor, 'conveyor.rung'))
    editor.element('Rung 1, ')
    editor.to_sheet()
    editor.keys('Insert')
    editor.entry('OUT %QX7.7')
    editor.element('%QX7.7')
    until(lambda: any('%QX7.7' in read(draft) for draft in drafts(screen)), 'the draft')
    editor.kill()
    editor = Editor(screen)
    editor.element('%QX7.7')
    editor.keys('ctrl+F5')
    editor.find(' passed', 'label')
    proposes(editor)
    editor.give_path(path, 'ctrl+s')
    editor.find('Saved, together with the files of the sample: mine.plant.rung, mine.scn', 'label')
    assert '%QX7.7' in open(path).read()


def listed(editor):
    """Returns the names of the recent files on the welcome page."""
    names = [node.name for node in editor.all(editor.screen.home, 'label')]
    return [os.path.basename(name) for name in names]


def to_item(editor, name):
    """Moves down to an item of the open menu."""
    item = editor.focus_on(role='menu item')
    while item.name != name:
        editor.keys('Down')
        item = editor.focus_on(role='menu item', but=item)


def lately(screen):
    """recent files of all kinds are listed, the last one first; also in the menu, by keys"""
    files = [new_file(screen, PROGRAM, 'f_%d.rung' % number) for number in range(10)]
    files.append(shutil.copy(CLASSIC, os.path.join(screen.home, 'mill.clp')))
    kept = os.path.join(screen.home, '.local', 'share', 'recently-used.xbel')
    # All within a second, and the first one twice.
    editor = Editor(screen, *files, files[1])
    until(lambda: os.path.exists(kept) and 'mill.clp' in open(kept).read(), 'the files to be kept')
    editor.finish()
    shutil.rmtree(os.path.join(screen.home, 'state'))  # the draft of the unsaved work does not exist yet
    os.unlink(files[9])
    wanted = ['f_1.rung', 'mill.clp', *('f_%d.rung' % number for number in (8, 7, 6, 5, 4, 3))]
    editor = Editor(screen)
    until(lambda: listed(editor), 'the files of before')
    editor.shot('begin-recent')
    assert listed(editor) == wanted, listed(editor)
    editor.keys('F10')
    to_item(editor, 'File')
    editor.keys('Right')
    to_item(editor, 'Open recent')
    editor.keys('Right')
    folder = os.path.basename(screen.home)
    to_item(editor, os.path.join(folder, 'f_7.rung'))
    editor.shot('begin-recent-menu')
    rows = [os.path.basename(node.name) for node in editor.all(folder, 'menu item')]
    assert rows == wanted, rows
    editor.keys('Return')
    editor.element('Rung 1, NO', 'Start')
    editor.says('f_7')

    def newest():
        editor.keys('F10')
        rows = until(lambda: [node.name for node in editor.all(folder, 'menu item')], 'the rows')
        editor.keys('Escape')
        return rows[0].endswith('f_7.rung')
    until(newest, 'it to be the newest')


def only_projects(screen):
    """tables, maps and pages chosen in a dialog remove no project from the recent files"""
    path = new_file(screen, PROGRAM)
    tables = [new_file(screen, 'Scope,Name,Type,Address\n', 'names_%d.csv' % number) for number in range(3)]
    kept = os.path.join(screen.home, '.local', 'share', 'recently-used.xbel')
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    for table in tables:
        before = editor.windows()
        editor.brought(lambda: editor.give_path(table, editor.find('Import', 'push button').press))
        editor.keys('Escape')
        until(lambda: len(editor.windows()) == len(before), 'the end of the plan')
    editor.give_path(os.path.join(screen.home, 'out.csv'), editor.find('Export', 'push button').press)
    until(lambda: 'names_2.csv' in read(kept), 'the tables to be kept by the toolkit')
    editor.finish()
    editor = Editor(screen)
    until(lambda: listed(editor), 'the files of before')
    editor.shot('begin-only-projects')
    assert listed(editor) == [os.path.basename(path)], listed(editor)


def empty(screen):
    """Simulate shows the sheet; New project leads from the welcome page to it, with a hint; a typed name becomes a contact"""
    editor = Editor(screen)
    editor.click(editor.find('Simulate'))
    editor.says('SIMULATION')
    editor.to_sheet()
    editor.keys('ctrl+m', 'ctrl+Page_Down', 'ctrl+Page_Down')
    editor.click(editor.find('An empty sheet', 'label'))
    editor.to_sheet()
    until(lambda: not editor.all('Samples, opened as copies'), 'the page to be gone')
    editor.shot('begin-empty')
    editor.entry('Start')
    editor.element('Rung 1, NO', 'Start')


def statements(screen):
    """a project in Structured Text is begun from the welcome page; what is typed next is its first statement"""
    path = os.path.join(screen.home, 'lamp.rung')
    editor = Editor(screen)
    editor.click(editor.find('New project in Structured Text', 'label'))
    until(lambda: not editor.all('Samples, opened as copies'), 'the page to be gone')
    editor.focus_on(role='text')
    editor.type('Q0 := I0;')
    editor.shot('begin-statements')
    editor.give_path(path, 'ctrl+s')
    until(lambda: os.path.exists(path) and 'PROGRAM Main ST\n  Q0 := I0;\nEND_PROGRAM' in open(path).read(), 'the statement in the file')
    check(path)


def networks(screen):
    """a project with networks is begun from the welcome page; what is typed next is its first box"""
    path = os.path.join(screen.home, 'fill.rung')
    editor = Editor(screen)
    editor.click(editor.find('New project with networks', 'label'))
    until(lambda: not editor.all('Samples, opened as copies'), 'the page to be gone')
    until(lambda: [node for node in editor.all('Networks') if node.name == 'Networks' and node.has(12)], 'the keys in the networks')
    editor.type('A')
    editor.opened()
    editor.entry('ND')
    until(lambda: editor.all('AND, executed as number 1'), 'the box')
    editor.shot('begin-networks')
    editor.give_path(path, 'ctrl+s')
    until(lambda: os.path.exists(path) and 'PROGRAM Main FBD' in open(path).read(), 'the network in the file')
    editor.finish()


def searched(screen):
    """the palette finds an element by its word or its description; Return puts it at the cursor, Escape ends the search"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find an element')
    editor.type('on-delay')
    until(lambda: not editor.all('Coils', 'push button', editor.palette), 'the coils to be gone')
    editor.tile('TON')
    editor.shot('begin-search')
    editor.keys('Escape')
    editor.to_sheet()
    until(lambda: editor.all('Coils', 'push button', editor.palette), 'all elements')
    editor.keys('Home', 'Right', 'ctrl+shift+e')
    editor.focus_on('Find an element')
    editor.type('TON')
    editor.keys('Return')
    editor.opened()
    editor.entry('Delay')
    text = editor.save(path)
    assert 'TON Delay' in text, text
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == PROGRAM
    # Without a sheet there is no palette.
    editor.keys('ctrl+Page_Down')
    until(lambda: not editor.all('Find an element'), 'the palette to be gone')
    editor.keys('ctrl+shift+e')
    editor.says('This works on a sheet. Open a sheet first.')


def folded(screen):
    """a family folds by pointer and by key; the sides of the window fold"""
    editor = Editor(screen, new_file(screen, PROGRAM))
    editor.tile('NO: ')
    x, y, width, _ = editor.place(editor.all('Contacts', 'push button', editor.palette)[0])
    title = x + width // 2, y + 10
    editor.click(title)
    until(lambda: not editor.all('NO: ', 'push button', editor.palette), 'the tiles to be gone')
    editor.click(title)
    editor.tile('NO: ')
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find an element')
    editor.keys('Tab')  # to the wires, which are folded at first
    before = len(editor.all(role='push button', below=editor.palette))
    editor.keys('space')
    until(lambda: len(editor.all(role='push button', below=editor.palette)) > before, 'the tiles of the wires')
    editor.keys('space')
    for key, what in ('F4', 'Find an element'), ('shift+F4', 'Instruction list'):
        editor.keys(key)
        until(lambda: not editor.all(what), what + ' to be gone')
        editor.keys(key)
        editor.says(what)


def read(path):
    with open(path, newline='') as file:
        return file.read()


def tables(screen):
    """symbols are exported to a table and imported again; the preview tells what each line changes or breaks"""
    path = new_file(screen, PROGRAM)
    table = os.path.join(screen.home, 'names.csv')
    editor = Editor(screen, path)
    editor.keys('ctrl+alt+s')
    for answer in None, 'Cancel', 'Replace':
        editor.give_path(table[:-4], editor.find('Export', 'push button').press)
        if answer:
            editor.find('Replace the file?')
            assert read(table) == 'precious'
            editor.answer(answer)
        if answer != 'Cancel':
            editor.find('Exported 2 symbols to %s' % table)
            text = read(table)
            assert 'Start,BOOL,%IX0.0' in text and 'the green one' in text, text
        with open(table, 'w') as file:
            file.write('precious')
    with open(table, 'w', newline='') as file:
        file.write(text.replace('the green one', 'on the door') + ',,Horn,BOOL,%QX0.1,,,,\r\n' +
                   ',VAR_TEMP,Away,BOOL,,,,,\r\n,VAR,Twice,BOOL,%IX0.0,,,,\r\n,VAR,Open,INT,,,,,"no end\r\n')
    editor.give_path(table, editor.find('Import', 'push button').press)
    editor.shot('begin-table')
    editor.says('2 new, 1 changed, 1 unchanged, 2 refused; after 2 of these lines the program has faults')
    for line in ('line 5, Away, refused, "VAR_TEMP" does not belong here', 'line 6, Twice, new, also used as Start',
                 'line 7, , refused, a quoted field does not end; the rest of the table was not read'):
        editor.find(line)
    next(node for node in editor.all('Import', 'push button') if node.name in ('Import', 'Import Import')).press()
    until(lambda: len(editor.windows()) == 1, 'the end of the plan')
    saved = editor.save(path)
    assert 'on the door' in saved and 'Horn AT %QX0.1 : BOOL' in ' '.join(saved.split()), saved
    assert 'Away' not in saved and 'Open' not in saved
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == PROGRAM


if __name__ == "__main__":
    main([sample, cards, folder, parts, belongings, killed, lately, only_projects, empty, statements, networks, searched, folded, tables])
