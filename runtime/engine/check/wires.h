/* SPDX-License-Identifier: MIT
 *
 * wires - the wires of networks in FBD: targets that are declared nowhere.
 *
 * Each is a variable of its POU behind those that are declared (VAR_WIRE), with a name of its own
 * (fbd_wire_name()) and the type of its value.
 */
#ifndef CHECK_WIRES_H
#define CHECK_WIRES_H

#include "engine/base/diag.h"
#include "engine/check/scope.h"

/** wires_make - the wires of all networks, after the project was read; @scratch may be reset behind it.
 * Scan-safe: no. Fails: false: no memory, or types that are too large in @diags. */
bool wires_make(struct project *project, struct arena *scratch, struct diag_list *diags);
/** wires_operand - an operand of network @network with the names of its wires replaced by those of their
 * variables; @operand itself if it has none. Scan-safe: no. */
uint32_t wires_operand(struct project *project, const struct pou *pou, int network, uint32_t operand);
/** wires_declare - for a printed list of @pou, which is @il: wires get names that can be declared. Nothing may
 * ask for them behind it. Scan-safe: no. Fails: false: no memory. */
bool wires_declare(struct project *project, struct pou *pou, struct il *il);
#endif
