/* SPDX-License-Identifier: MIT
 *
 * sfc_check - what the parts of the check of a chart share.
 *
 * Private to check/. check_sfc looks at steps and transitions, check_sfc_lines at what
 * steps do and at what the chart is operated with, check_sfc_bodies at what conditions
 * and actions are made of.
 */
#ifndef CHECK_SFC_CHECK_H
#define CHECK_SFC_CHECK_H

#include "engine/check/check_sfc.h"

struct sfc_check {
	struct scope *scope;
	struct project *project;
	const struct pou *pou;
	const struct sfc *sfc;
	struct arena *scratch;
	struct diag_list *diags;
	int *mark;                /* by folded name: where a label stood last     */
	bool good;
};

/** sfc_report - a diagnostic with a line and column of the chart. False: an error. */
bool sfc_report(struct sfc_check *c, enum diag_id id, int line, int column,
		const char *arg);
/** sfc_name - the text of an id. */
const char *sfc_name(const struct sfc_check *c, uint32_t id);
/** sfc_mark - where c->mark has something of this name; NULL: no name. */
int *sfc_mark(struct sfc_check *c, uint32_t name);

void sfc_check_lines(struct sfc_check *c);
void sfc_check_bodies(struct sfc_check *c);
#endif
