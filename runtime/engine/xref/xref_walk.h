/* SPDX-License-Identifier: MIT
 *
 * xref_walk - what the two halves of the cross reference share. Private to xref/.
 */
#ifndef XREF_WALK_H
#define XREF_WALK_H

#include "engine/check/scope.h"
#include "engine/xref/xref.h"

/* On the way through a project. */
struct xref_walk {
	struct xref *out;
	struct project *project;
	struct scope *scope;
	const struct pou *pou;   /* whose names are seen; NULL: globals       */
	struct xref_use place;   /* where we are                              */
	uint32_t *slot;          /* the text that is looked at                */
	struct xref_label *label; /* by folded name                           */
	uint32_t labels;
	int body;                /* of labels: one of each POU, of a chart many */
	enum word call;          /* of the call in a list whose pins follow   */
};

/** xref_add - one use, at walk->place. */
struct xref_use *xref_add(struct xref_walk *walk, struct xref_target target,
			  enum xref_kind kind, uint32_t at, uint32_t len);
/** xref_begin - what follows stands in a line of the file that is no rung. */
void xref_begin(struct xref_walk *walk, const struct pou *pou, int line, int column);
/** xref_all - the names in all of a text; xref_whole - all of it names @target. */
void xref_all(struct xref_walk *walk, uint32_t *slot, enum xref_kind kind);
void xref_whole(struct xref_walk *walk, uint32_t *slot, struct xref_target target,
		enum xref_kind kind);
/** xref_body - a condition or an action of a chart. */
void xref_body(struct xref_walk *walk, struct pou *pou, const struct sfc_body *body);
/** xref_sfc - all of a chart but its declarations. */
void xref_sfc(struct xref_walk *walk, struct pou *pou);
/** xref_scan - the names in @len bytes of the text of walk->slot from @at on
 * @kind: what happens to the first of them, up to `:=` if there is one */
void xref_scan(struct xref_walk *walk, size_t at, size_t len, enum xref_kind kind);
/** xref_loop - what stands behind FOR. */
void xref_loop(struct xref_walk *walk);
/** xref_pin - parameter @name of a word: XREF_UNKNOWN if it is not the project's.
 * @dir: gets its direction; of those that are none PIN_NONE. */
struct xref_target xref_pin(struct xref_walk *walk, enum word word, const char *name,
			    size_t len, enum pin_dir *dir);

#endif
