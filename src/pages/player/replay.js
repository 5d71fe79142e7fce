// The replay of the run: from event to event where the file holds them, else from sample to sample.
"use strict";

const replay = description.exact ? exactReplay() : sampleReplay();
