/* SPDX-License-Identifier: MIT
 *
 * board_copy - what a download sends and an upload gives back: code image, I/O map, and the
 * files of the project.
 *
 * Names of files come from outside: board_copy_read() refuses those that would leave the folder.
 * It shows nothing; only board_copy_save() writes files.
 */
#ifndef EDITOR_BOARD_COPY_H
#define EDITOR_BOARD_COPY_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/online/board_link.h"

#include "online/stored.h"

struct board_copy {
	GBytes *image;
	char *map;
	char *name, *text;     /* the program; NULL: there are no sources      */
	GHashTable *files;     /* files that it names: GBytes by name          */
	GHashTable *parts;     /* not empty: the program is several files of plain IEC text, GBytes by
				  name, which @text joins; @name is that of a folder for them */
};

/** board_copy_read - Owns: board_copy_free(). Fails: NULL: it is damaged, or has a name that
 * leaves the folder. */
struct board_copy *board_copy_read(const struct stored *stored);
void board_copy_free(struct board_copy *copy);
/** board_copy_give_files - @reader finds the files that the program names. */
void board_copy_give_files(const struct board_copy *copy, struct ladder *reader);
/** board_copy_make_lists - without sources: `name` and `text` become the program as instruction lists
 * made from the image. Returns NULL, or what they lack, a line each; caller frees. Fails: `text` stays
 * NULL. */
char *board_copy_make_lists(struct board_copy *copy);
/**
 * board_copy_save - writes program, files and map into @folder
 * @map: name of the file of the map, "garage-door.io"
 *
 * All or nothing: if one of them is there already, or cannot be written, what was written goes
 * again. Nothing is ever replaced. A program of several files gets a new folder in @folder. Returns
 * NULL, or why not; caller frees.
 */
char *board_copy_save(const struct board_copy *copy, const char *folder, const char *map);

/* A program that can be downloaded. */
struct board_program {
	struct stored stored;  /* in `bytes`                                   */
	GByteArray *bytes;
	guint8 identity[32];
};
/** board_program_new - builds the document as it is now. @map: the text of its I/O map. Owns:
 * board_program_unref(). Fails: NULL, and @error is the first error. */
struct board_program *board_program_new(LadderDocument *document, const char *map, GError **error);
struct board_program *board_program_ref(struct board_program *program);
void board_program_unref(gpointer program);

/** board_copied - @copy: to be kept or freed with board_copy_free(); NULL: @why. @locked: because
 * of the program password: board_unlock() first. */
typedef void (*board_copied)(gpointer data, struct board_copy *copy, const char *why, bool locked);
/** board_upload - gets what the board stores; @owner, @data: as ladder_board_link_send(). */
void board_upload(LadderBoardLink *link, gpointer owner, board_copied copied, gpointer data);
/** board_unlock - gives the program password: this session may upload then. */
void board_unlock(LadderBoardLink *link, const char *password, gpointer owner,
		  board_answered answered, gpointer data);

#endif
