/* SPDX-License-Identifier: MIT
 *
 * rung_clip - rungs on their way from project to project, as text of a rung file, with the
 * declarations of the names they use.
 *
 *   VAR_GLOBAL
 *     Start AT %IX0.0 : BOOL;
 *   END_VAR
 *   VAR
 *     Delay : TON;
 *   END_VAR
 *   RUNG
 * NO Start
 * TON Delay PT:=T#1s
 * COIL %QX0.0 |
 *
 * VAR_GLOBAL are globals of the project, VAR locals of the program. It also reads a whole
 * file, a rung without the word RUNG, and lines of mnemonics. It inserts no rungs, and
 * never changes an existing declaration.
 */
#ifndef EDITOR_RUNG_CLIP_H
#define EDITOR_RUNG_CLIP_H

#include "editor-gtk/document/symbols.h"

#define RUNG_CLIP_MOST (LIMIT_RUNGS + 1) /* more than a POU can hold: the caller refuses it */

struct rung_clip {
	struct rung **rung;     /* strings are ids of the document's project   */
	int count;
	LadderDocument *source; /* the project with the declarations           */
};

/** rung_clip_text - rungs of POU @pou, or a part of one, for the clipboard, with the
 * declarations of their names. Caller frees; NULL: a rung cannot be written. */
char *rung_clip_text(LadderDocument *document, int pou, struct rung *const *rungs,
		     int count);
/** rung_clip_blocks - appends the declarations of the names in a text of POU @pou to
 * @globals and @locals. */
void rung_clip_blocks(LadderDocument *document, int pou, const char *text, GString *globals,
		      GString *locals);
/**
 * rung_clip_source - a project for declarations, without checks
 * @body:  of its file, behind the first line. Unknown types there become structures, so
 *         that their variables can be read
 * @diags: gets why it cannot be read; the body begins in line 3
 *
 * Owns: the caller, g_object_unref().   Fails: NULL.
 */
LadderDocument *rung_clip_source(const char *body, struct diag_list *diags);

/**
 * rung_clip_read - the rungs of a text, for POU @pou of @document
 * @text: any @len bytes
 * @why:  gets a translated reason, which the caller frees
 *
 * Owns: the caller, rung_clip_free().   Fails: NULL; only strings were added.
 */
struct rung_clip *rung_clip_read(LadderDocument *document, int pou, const char *text,
				 gsize len, char **why);
/** rung_clip_take - moves the rungs to the caller. Owns: the caller, g_free(). */
struct rung **rung_clip_take(struct rung_clip *clip);
void rung_clip_free(struct rung_clip *clip);

/**
 * rung_clip_declare - declares the unknown names in @count rungs of a POU from @at on
 *
 * Only if the source declares them and the type is known here. A variable whose address is
 * taken here gets none. Part of an open step, or a step of its own.
 * Returns a message, translated; NULL: nothing was declared. Owns: the caller, g_free().
 */
char *rung_clip_declare(const struct rung_clip *clip, LadderDocument *document, int pou,
			int at, int count);

#endif
