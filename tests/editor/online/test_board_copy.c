/* SPDX-License-Identifier: MIT
 *
 * test_board_copy - what is sent to a board comes back as it was; hostile names leave no folder; no
 * file is replaced, and a copy is written whole or not at all. And serial ports that come and go.
 */
#include "editor-gtk/online/board_copy.h"
#include "editor-gtk/online/board_finder.h"
#include "tests/editor/online/board.h"

#include <string.h>

static LadderDocument *document_at(const char *folder)
{
	LadderDocument *document = ladder_document_new();
	char *path = g_build_filename(folder, "seal.rung", NULL);

	ladder_document_open_text(document, path, BOARD_PROGRAM, strlen(BOARD_PROGRAM), true);
	g_free(path);
	return document;
}

static void comes_back(const char *folder)
{
	LadderDocument *document = document_at(folder);
	struct board_program *program = board_program_new(document, BOARD_MAP, NULL);
	struct board_copy *copy;
	char *why, *path = g_build_filename(folder, "seal.rung", NULL), *text = NULL;

	CHECK(program && stored_size(&program->stored) == program->bytes->len);
	copy = board_copy_read(&program->stored);
	CHECK_TEXT(copy->name, "seal.rung");
	CHECK_TEXT(copy->text, BOARD_PROGRAM);
	CHECK_TEXT(copy->map, BOARD_MAP);
	why = board_copy_save(copy, folder, "seal.io");
	CHECK_AS(!why, "it is written");
	CHECK(g_file_get_contents(path, &text, NULL, NULL));
	CHECK_TEXT(text, BOARD_PROGRAM);
	g_free(copy->text);
	copy->text = g_strdup("other");
	why = board_copy_save(copy, folder, "seal.io");
	CHECK_AS(why && strstr(why, "is there already"), "no file is replaced");
	g_free(text);
	g_file_get_contents(path, &text, NULL, NULL);
	CHECK_TEXT(text, BOARD_PROGRAM);
	for (uint32_t len = 0; len < program->stored.len[STORED_SOURCES]; len++) {
		struct stored cut = program->stored;
		struct board_copy *part;

		cut.len[STORED_SOURCES] = len;
		part = board_copy_read(&cut);
		if (part && len)
			CHECK_AS(false, "a program that was cut is refused");
		board_copy_free(part);
	}
	g_free(why);
	g_free(text);
	g_free(path);
	board_copy_free(copy);
	board_program_unref(program);
	g_object_unref(document);
}

static bool is_there(const char *folder, const char *name)
{
	char *path = g_build_filename(folder, name, NULL);
	const bool there = g_file_test(path, G_FILE_TEST_EXISTS);

	g_free(path);
	return there;
}

/* A hostile name that the map needs for itself: the map comes last. */
static void leaves_nothing(const char *folder)
{
	LadderDocument *document = document_at(folder);
	struct board_program *program = board_program_new(document, BOARD_MAP, NULL);
	struct board_copy *copy = board_copy_read(&program->stored);
	char *why;

	g_free(copy->name);
	copy->name = g_strdup("new.rung");
	g_hash_table_insert(copy->files, g_strdup("lib/deep/part.rung"), g_bytes_new("x", 1));
	g_hash_table_insert(copy->files, g_strdup("new.io/part.rung"), g_bytes_new("x", 1));
	why = board_copy_save(copy, folder, "new.io");
	CHECK_AS(why && strstr(why, "nothing was written"), "the map cannot be written");
	CHECK_AS(!is_there(folder, "new.rung") && !is_there(folder, "new.io") &&
		 !is_there(folder, "lib"), "what was written goes again");
	CHECK(is_there(folder, "seal.rung"));
	g_free(why);
	g_hash_table_remove(copy->files, "new.io/part.rung");
	why = board_copy_save(copy, folder, "new.io");
	CHECK(!why && is_there(folder, "lib/deep/part.rung") && is_there(folder, "new.io"));
	g_free(why);
	board_copy_free(copy);
	board_program_unref(program);
	g_object_unref(document);
}

static bool takes(const char *name)
{
	uint8_t bytes[300];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct stored stored = { .bytes = bytes };
	struct board_copy *copy;

	wire_put_u16(&out, 1);
	wire_put_string(&out, name);
	wire_put_u32(&out, 1);
	wire_put_u8(&out, 'x');
	stored.len[STORED_SOURCES] = (uint32_t)wire_len(&out);
	copy = board_copy_read(&stored);
	board_copy_free(copy);
	return copy != NULL;
}

static void hostile(void)
{
	CHECK(takes("a.rung") && takes("lib/a.rung"));
	CHECK(!takes("") && !takes("/etc/passwd") && !takes("../a") && !takes("a/../../b") &&
	      !takes(".bashrc") && !takes("a/.x") && !takes("a\nb") && !takes("a/") &&
	      !takes("\xff"));
}

/* Two files of IEC text, stored by a command, are one program here, also if a block of theirs has the
 * name of a block of the catalogue; they come back as they were, in a new folder. */
static void several(const char *folder)
{
	static const char *const file[][2] = {
		{ "main.st", "PROGRAM Main\nVAR\n  R : Ramp;\nEND_VAR\n  R();\nEND_PROGRAM\n" },
		{ "deep/ramp.st", "FUNCTION_BLOCK Ramp\nVAR_OUTPUT\n  Y : INT;\nEND_VAR\n"
				  "  Y := Y + 1;\nEND_FUNCTION_BLOCK\n" },
	};
	uint8_t bytes[600];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct stored stored = { .bytes = bytes };
	LadderDocument *document = ladder_document_new();
	struct board_copy *copy;
	char *why, *text = NULL, *path, *map = g_build_filename(folder, "program.io", NULL);

	wire_put_u16(&out, 2);
	for (int i = 0; i < 2; i++) {
		wire_put_string(&out, file[i][0]);
		wire_put_u32(&out, (uint32_t)strlen(file[i][1]));
		wire_put_bytes(&out, file[i][1], strlen(file[i][1]));
	}
	stored.len[STORED_SOURCES] = (uint32_t)wire_len(&out);
	copy = board_copy_read(&stored);
	CHECK(copy && copy->text && g_hash_table_size(copy->parts) == 2);
	ladder_document_open_text(document, NULL, copy->text, strlen(copy->text), true);
	ladder_document_check_now(document);
	CHECK_AS(ladder_document_project(document) && ladder_document_diags(document)->errors == 0,
		 "the joined text is a program");
	CHECK_TEXT(copy->name, "program");
	why = board_copy_save(copy, folder, "program.io");
	CHECK_AS(!why && g_file_test(map, G_FILE_TEST_EXISTS), "all is written");
	for (int i = 0; i < 2; i++) {
		path = g_build_filename(folder, "program", file[i][0], NULL);
		CHECK(g_file_get_contents(path, &text, NULL, NULL));
		CHECK_TEXT(text, file[i][1]);
		g_clear_pointer(&text, g_free);
		g_free(path);
	}
	g_unlink(map);
	why = board_copy_save(copy, folder, "program.io");
	CHECK_AS(why && strstr(why, "is there already"), "no folder gets files of another program");
	CHECK(!g_file_test(map, G_FILE_TEST_EXISTS));
	g_free(why);
	g_free(map);
	board_copy_free(copy);
	g_object_unref(document);
}

static int changes;

static void changed(void)
{
	changes++;
}

/* The places of one kind, joined. Caller frees. */
static char *found(LadderBoardFinder *finder, enum found_kind kind)
{
	GPtrArray *list = ladder_board_finder_list(finder);
	GString *all = g_string_new(NULL);

	for (guint i = 0; i < list->len; i++) {
		const struct board_found *one = list->pdata[i];

		if (one->kind == kind)
			g_string_append_printf(all, "%s|", one->where);
	}
	return g_string_free(all, FALSE);
}

static void ports(const char *folder)
{
	char *usb = g_build_filename(folder, "ttyUSB0", NULL);
	char *other = g_build_filename(folder, "tty1", NULL), *all, *want;
	LadderBoardFinder *finder = ladder_board_finder_new(folder);

	g_signal_connect(finder, "changed", G_CALLBACK(changed), NULL);
	all = found(finder, FOUND_HERE);
	CHECK_TEXT(all, "unix:|");
	g_free(all);
	all = found(finder, FOUND_SERIAL);
	CHECK_TEXT(all, "");
	g_free(all);
	changes = 0;
	g_file_set_contents(usb, "", 0, NULL);
	g_file_set_contents(other, "", 0, NULL);
	CHECK_SOON(changes > 0 && ladder_board_finder_list(finder)->len > 1);
	all = found(finder, FOUND_SERIAL);
	want = g_strdup_printf("serial:%s|", usb);
	CHECK_TEXT(all, want);
	g_unlink(usb);
	CHECK_SOON(ladder_board_finder_list(finder)->len == 1);
	g_object_unref(finder);
	g_free(want);
	g_free(all);
	g_free(other);
	g_free(usb);
}

int main(void)
{
	struct test_board board = { .folder = g_dir_make_tmp("copy-XXXXXX", NULL) };

	comes_back(board.folder);
	leaves_nothing(board.folder);
	several(board.folder);
	hostile();
	ports(board.folder);
	board_close(&board);
	return tap_done();
}
