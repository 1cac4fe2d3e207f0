#include "support.h"  // which thereby is seen to compile alone
