/* SPDX-License-Identifier: MIT
 *
 * diff_networks - what differs between two versions of a function block diagram: networks, and the boxes of
 * a network.
 *
 * For the picture of a comparison and for the page of one. It draws nothing.
 */
#ifndef EDITOR_DIFF_NETWORKS_H
#define EDITOR_DIFF_NETWORKS_H

#include "editor-gtk/draw/fbd_draw.h"

/* A network that differs: its number, from 0, in each version; -1: it has none. */
struct diff_network {
	int a, b;
	bool moved;   /* nothing but its place differs                          */
	char *words;  /* lines that only one version has, after - or +          */
};
/** diff_networks - those of two POUs (struct diff_network), in the order of reading; a POU may be NULL.
 * Owns: the caller, g_array_unref(). */
GArray *diff_networks(const struct project *a, const struct pou *pou_a, const struct project *b,
		      const struct pou *pou_b);
/** diff_mark_boxes - marks the boxes of @own that @other does not have like this (struct fbd_mark). Owns: the
 * caller, g_array_unref(). */
GArray *diff_mark_boxes(const struct fbd_graph *own, const struct fbd_graph *other);

#endif
