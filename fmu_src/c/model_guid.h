/* The GUID of the model description. The build puts that of the FMU's content in place of this one,
 * which serves sources that are compiled where they lie. */
#ifndef SLIDER_MODEL_GUID_H
#define SLIDER_MODEL_GUID_H

#define MODEL_GUID "00000000-0000-0000-0000-000000000000"

#endif
