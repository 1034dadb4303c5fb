/* SPDX-License-Identifier: MIT
 *
 * rung_clip - rungs on their way from project to project, as text of a rung file, with
 * the declarations of what they use.
 *
 *   VAR_GLOBAL
 *     Start AT %IX0.0 : BOOL;
 *   END_VAR
 *   VAR
 *     Delay : TON;
 *   END_VAR
 *   RUNG
 *     | NO Start | TON Delay PT:=T#1s | COIL %QX0.0 |
 *
 * VAR_GLOBAL are those of the project, VAR those of the program. A whole file is read too,
 * a rung without its word, and lines of mnemonics. It puts no rung anywhere, and never changes
 * a declaration that is there.
 */
#ifndef EDITOR_RUNG_CLIP_H
#define EDITOR_RUNG_CLIP_H

#include "editor-gtk/document/symbols.h"

#define RUNG_CLIP_MOST (LIMIT_RUNGS + 1) /* one is too much for any POU: who puts them tells */

struct rung_clip {
	struct rung **rung;     /* strings are ids of the document's project   */
	int count;
	LadderDocument *source; /* that has the declarations                   */
};

/** rung_clip_text - rungs of POU @pou, or a part of one, for the clipboard, with the
 * declarations of what they name. Caller frees; NULL: one cannot be written. */
char *rung_clip_text(LadderDocument *document, int pou, struct rung *const *rungs,
		     int count);
/** rung_clip_blocks - the declarations of what a text of POU @pou names, as blocks behind
 * what stands in @globals and @locals. */
void rung_clip_blocks(LadderDocument *document, int pou, const char *text, GString *globals,
		      GString *locals);
/**
 * rung_clip_source - a project that nobody sees and no check is made of
 * @body:  of its file, behind the first line. Types that nobody declares there become
 *         structures, so that what is of them can be read
 * @diags: gets why it cannot be read, lines counted from two before the body
 *
 * Owns: the caller, g_object_unref().   Fails: NULL.
 */
LadderDocument *rung_clip_source(const char *body, struct diag_list *diags);

/**
 * rung_clip_read - the rungs of a text, to be put into POU @pou of @document
 * @text: any @len bytes
 * @why:  gets a translated reason, which the caller frees
 *
 * Owns: the caller, rung_clip_free().   Fails: NULL; nothing but strings was added.
 */
struct rung_clip *rung_clip_read(LadderDocument *document, int pou, const char *text,
				 gsize len, char **why);
/** rung_clip_take - the rungs are the caller's from now on. Owns: the caller, g_free(). */
struct rung **rung_clip_take(struct rung_clip *clip);
void rung_clip_free(struct rung_clip *clip);

/**
 * rung_clip_declare - what @count rungs of a POU name from @at on and nobody declared
 *
 * As far as the source has it, and its type is known here. One whose address is
 * another's here comes without it. Part of an open step, or a step of its own.
 * Returns what was done, translated; NULL: nothing. Owns: the caller, g_free().
 */
char *rung_clip_declare(const struct rung_clip *clip, LadderDocument *document, int pou,
			int at, int count);

#endif
