#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""drafts - unsaved work is restored after a kill."""
import os
import re
import resource
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402
from outcome import drafts  # noqa: E402
from projects import ONE_RUNG  # noqa: E402

SCENARIO = 'scenario One\n'


def after_a_kill(screen):
    """save, draw on, kill -9: the next start restores all of it"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('OUT Motor')
    saved = editor.save(path)
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Motor')
    until(lambda: any('^' in open(file).read() for file in drafts(screen)), 'the draft')
    editor.kill()
    assert open(path).read() == saved, 'the file itself was touched'
    again = Editor(screen)
    again.says('The editor ended before this was saved')
    until(lambda: len(again.cells()) == 3, 'the three elements')
    again.shot('drafts-restored')
    again.to_sheet()
    again.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\nStart=0\n') == ['Motor=0', 'Motor=1', 'Motor=1']
    until(lambda: not drafts(screen), 'the draft to go with the save')


def changed_meanwhile(screen):
    """the file changed on disk after the kill: saving asks before it replaces it; one window holds the file"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    editor.entry('OUT Motor')
    other = editor.save(path) + '(* of somebody else *)\n'
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('Motor')
    until(lambda: any('^' in open(file).read() for file in drafts(screen)), 'the draft')
    editor.kill()
    with open(path, 'w') as file:
        file.write(other)
    again = Editor(screen, path)
    again.says('The editor ended before this was saved')
    until(lambda: len(again.cells()) == 3, 'the three elements')
    assert len(again.windows()) == 1
    again.to_sheet()
    again.keys('ctrl+s')
    again.says('Saving would overwrite those changes')
    assert open(path).read() == other
    again.click(again.find('Save anyway', 'push button'))
    until(lambda: open(path).read() != other, 'the file to be written')
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\nStart=0\n') == ['Motor=0', 'Motor=1', 'Motor=1']


def scenario(screen):
    """An editor with an unsaved line in its scenario, and the path of the scenario."""
    path = new_file(screen, ONE_RUNG)
    beside = os.path.join(screen.home, 'new.scn')
    with open(beside, 'w') as file:
        file.write(SCENARIO)
    editor = Editor(screen, path)
    editor.click(editor.find('new.scn', 'label'), count=2)
    view = editor.find('new.scn', 'text')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the scenario')
    editor.keys('ctrl+End')
    editor.type('# mine')
    until(lambda: any('# mine' in open(file).read() for file in drafts(screen)), 'the draft')
    return editor, beside


def beside_a_project(screen):
    """an edited scenario is restored with its project; a change on disk is not overwritten"""
    editor, path = scenario(screen)
    editor.kill()
    with open(path, 'w') as file:
        file.write('# theirs')
    again = Editor(screen)
    again.says('The editor ended before this was saved')
    again.says('• new.scn')
    again.shot('drafts-scenario')
    assert again.find('new.scn', 'text').text() == SCENARIO + '# mine' and len(again.windows()) == 1
    again.keys('ctrl+s')
    again.says('was changed by another program')
    assert open(path).read() == '# theirs'
    again.save(path)
    assert open(path).read() == SCENARIO + '# mine'
    until(lambda: not drafts(screen), 'the draft to go with the save')
    os.unlink(path)
    again.keys('ctrl+shift+w')
    again.answer('Save')
    until(lambda: os.path.exists(path), 'the file that was gone')
    assert open(path).read() == SCENARIO + '# mine'


def gone(screen):
    """a scenario whose file was deleted becomes a draft without an edit; also at the end of a session"""
    editor, path = scenario(screen)
    editor.save(path)
    until(lambda: not drafts(screen), 'the draft to go with the save')
    os.unlink(path)
    editor.says('• new.scn')
    until(lambda: drafts(screen), 'the draft of the last copy')
    editor.finish()
    again = Editor(screen)
    again.says('• new.scn')
    assert again.find('new.scn', 'text').text() == SCENARIO + '# mine'


def no_room_again(screen):
    """an old draft stays when the restored work cannot be written as a new draft"""
    editor, _ = scenario(screen)
    editor.kill()
    old = drafts(screen)
    again = Editor(screen, before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (50, resource.RLIM_INFINITY)))
    again.says('Cannot keep a draft')
    assert again.find('new.scn', 'text').text() == SCENARIO + '# mine' and drafts(screen) == old


def twice(screen):
    """two drafts of one file are both restored: the second is one undo step older"""
    editor, path = scenario(screen)
    editor.kill()
    old = drafts(screen)[0]
    with open(old) as file:
        first = file.read()
    with open(old.replace('.draft', '9.draft'), 'w') as file:
        file.write(first.replace('# mine', '# other'))
    again = Editor(screen)
    again.says('• new.scn')
    view = again.find('new.scn', 'text')
    texts = {view.text()}
    again.keys('ctrl+z')
    until(lambda: view.text() not in texts, 'the other')
    assert texts | {view.text()} == {SCENARIO + '# mine', SCENARIO + '# other'} and len(again.windows()) == 1


def same_number(screen):
    """the next editor has the process id of the killed one: its draft is restored all the same"""
    editor, path = scenario(screen)
    editor.kill()
    old = drafts(screen)[0]
    again = Editor(screen, path, before=lambda: os.rename(old, re.sub(r'/[0-9]+-', f'/{os.getpid()}-', old)))
    again.says('• new.scn')
    assert again.find('new.scn', 'text').text() == SCENARIO + '# mine'
    again.save(path)
    until(lambda: not drafts(screen), 'the draft to go with the save')


def of_another_version(screen):
    """a draft of another version opens as text with its problems; nothing is lost"""
    folder = os.path.join(screen.home, 'state', 'rungboard', 'drafts')
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, '1-2.draft'), 'wb') as file:
        file.write(b'RUNGBOARD-DRAFT 2\n' + ONE_RUNG.encode() + b'\0\xff mine')
    editor = Editor(screen)
    editor.says('The editor ended before this was saved')
    text = until(lambda: [view for view in editor.all('', 'text') if 'RUNGBOARD-DRAFT' in view.text()], 'the text')
    assert ONE_RUNG in text[0].text() and text[0].text().endswith('mine')
    editor.says('1 error')
    editor.shot('drafts-another-version')
    until(lambda: not any(name.endswith('/1-2.draft') for name in drafts(screen)), 'that one to go')
    assert ONE_RUNG in open(drafts(screen)[0]).read()


def not_wanted(screen):
    """a draft is deleted with its tab, and with the window"""
    for key in 'ctrl+shift+w', 'ctrl+w':
        editor, path = scenario(screen)
        editor.keys(key)
        editor.reply('Discard')
        until(lambda: not drafts(screen), 'the draft to go')
        assert open(path).read() == SCENARIO
        editor.kill()


def no_room(screen):
    """a draft that cannot be written is reported"""
    path = new_file(screen)
    editor = Editor(screen, path)
    sh('prlimit', '--pid', str(editor.process.pid), '--fsize=50:')
    editor.entry('Start')
    editor.says('Cannot keep a draft')
    editor.shot('drafts-no-room')


def at_the_end_of_a_session(screen):
    """SIGTERM keeps the last edit without a question, and the next start restores it"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.entry('Start')
    until(lambda: len(editor.cells()) == 1, 'the contact')
    editor.finish()
    assert len(drafts(screen)) == 1
    again = Editor(screen)
    again.says('The editor ended before this was saved')
    until(lambda: len(again.cells()) == 1, 'the contact')


main([after_a_kill, changed_meanwhile, beside_a_project, gone, twice, same_number,
      of_another_version, not_wanted, no_room, no_room_again, at_the_end_of_a_session])
