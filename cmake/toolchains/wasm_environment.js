// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
Module['preRun'] = () => Object.assign(ENV, process.env);
